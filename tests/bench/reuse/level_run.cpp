#include "level_run.hpp"

#include <stdexcept>

namespace bench {

Context context_of(const Mesh &mesh) {
  Context context = make_context();
  submit(context.get(), mesh);
  return context;
}

void set_level(tetlod_context *context, const std::string &preset, double part) {
  if (preset == "paper") {
    check(tetlod_set_preset(context, TETLOD_PRESET_PAPER), context);
    check(tetlod_set_sigma(context, part), context);
    return;
  }
  check(tetlod_set_preset(context, preset == "fast" ? TETLOD_PRESET_FAST : TETLOD_PRESET_ACCURATE), context);
  check(tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, part), context);
}

tetlod_run_report run(tetlod_context *context) {
  check(tetlod_run(context), context);
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  check(tetlod_fetch_report(context, &report), context);
  return report;
}

double rms_of(tetlod_context *context) {
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  check(tetlod_measure_error(context, 0, &error), context);
  return error.rms;
}

}  // namespace bench
