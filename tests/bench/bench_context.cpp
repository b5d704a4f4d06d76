#include "bench_context.hpp"

#include <stdexcept>
#include <string>

namespace bench {

void check(tetlod_status status, const tetlod_context *context) {
  if (status == TETLOD_OK) return;
  std::string message(tetlod_last_message(context, nullptr, 0), '\0');
  tetlod_last_message(context, message.data(), message.size() + 1);
  throw std::runtime_error("tetlod: " + (message.empty() ? tetlod_status_text(status) : message));
}

Context make_context() {
  tetlod_context *made = nullptr;
  check(tetlod_create(nullptr, &made), nullptr);
  return Context(made);
}

tetlod_array lent(std::int32_t type, std::size_t tuples, std::int32_t components, const void *data) {
  tetlod_array array{};
  array.struct_size = sizeof array;
  array.type = type;
  array.tuples = static_cast<std::int64_t>(tuples);
  array.components = components;
  array.data = const_cast<void *>(data);
  return array;
}

tetlod_array viewed(tetlod_status (*view)(const tetlod_context *, tetlod_array *), const tetlod_context *context) {
  tetlod_array array{};
  array.struct_size = sizeof array;
  check(view(context, &array), context);
  return array;
}

void submit(tetlod_context *context, const Mesh &mesh) {
  const tetlod_array points = lent(TETLOD_FLOAT64, mesh.points.size(), 3, mesh.points.data());
  const tetlod_array tets = lent(TETLOD_INT32, mesh.tets.size(), 4, mesh.tets.data());
  const tetlod_array values = lent(TETLOD_FLOAT64, mesh.values.size(), 1, mesh.values.data());
  check(tetlod_submit_points(context, &points), context);
  check(tetlod_submit_tets(context, &tets, 0), context);
  check(tetlod_submit_scalars(context, "scalar", &values), context);
}

}  // namespace bench
