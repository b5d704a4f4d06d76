#include "simplify.hpp"

#include "arrays.hpp"
#include "failure.hpp"
#include "interrupt.hpp"

namespace cli {
namespace {

constexpr int32_t kWarning = 2;

std::string last_message(const tetlod_context *context, tetlod_status status) {
  std::string text(tetlod_last_message(context, nullptr, 0), '\0');
  tetlod_last_message(context, text.data(), text.size() + 1);
  return text.empty() ? tetlod_status_text(status) : text;
}

void keep_warning(void *notes, int32_t, const char *message) {
  static_cast<std::vector<std::string> *>(notes)->push_back(message);
}

void submit(tetlod_context *context, const TetMesh &mesh) {
  const tetlod_array points = borrowed(mesh.points, 3), corners = borrowed(mesh.corners, 4),
                     values = borrowed(mesh.values, 1);
  check(tetlod_submit_points(context, &points), context);
  check(tetlod_submit_tets(context, &corners, 0), context);
  check(tetlod_submit_scalars(context, mesh.field.c_str(), &values), context);
  for (const CarriedArray &other : mesh.others) {
    const tetlod_array array = borrowed(other.reals, other.reals->GetNumberOfComponents());
    check(tetlod_submit_field(context, other.key().c_str(), other.association, &array), context);
  }
}

}  // namespace

void check(tetlod_status status, const tetlod_context *context) {
  if (status == TETLOD_OK) return;
  stop_if_interrupted();
  throw Failure(last_message(context, status), status == TETLOD_ERR_OPTION ? kWrongUsage : kFailed);
}

Context make_context(const Arguments &arguments) {
  tetlod_context *made = nullptr;
  check(tetlod_create(nullptr, &made), nullptr);
  Context context(made);
  if (arguments.preset) check(tetlod_set_preset(made, *arguments.preset), made);
  for (const auto &[option, value] : arguments.reals) check(tetlod_set_real(made, option, value), made);
  for (const auto &[option, value] : arguments.integers) check(tetlod_set_int(made, option, value), made);
  return context;
}

void simplify(tetlod_context *context, const TetMesh &mesh, ProgressBar &bar, std::vector<std::string> &notes) {
  submit(context, mesh);
  check(tetlod_set_progress(context, ProgressBar::on_progress, &bar), context);
  check(tetlod_set_log(context, keep_warning, &notes, kWarning), context);
  const CancelOnInterrupt cancel(context);
  check(tetlod_run(context), context);
  bar.clear();
}

tetlod_error_report measure(tetlod_context *context) {
  const CancelOnInterrupt cancel(context);
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  check(tetlod_measure_error(context, 1, &error), context);
  return error;
}

}  // namespace cli
