// Submitting the original: shapes are checked here, contents by the run.
#include <cinttypes>

#include "arguments.hpp"
#include "context.hpp"

namespace tetlod::capi {

namespace {

static_assert(keep_vertex == TETLOD_FLAG_KEEP && lock_vertex == TETLOD_FLAG_LOCK, "");

/// Component c of an array, as an array of one component.
StridedArray component(const StridedArray &array, int c) {
  StridedArray one = array;
  one.components = 1;
  if (one.tuples > 0) one.data += c * array.component_stride;
  return one;
}

void require_equal_lengths(const std::array<StridedArray, 3> &xyz) {
  if (xyz[0].tuples != xyz[1].tuples || xyz[0].tuples != xyz[2].tuples)
    fail(Status::argument, "x, y and z have %" PRId64 ", %" PRId64 " and %" PRId64 " tuples, not as many each",
         xyz[0].tuples, xyz[1].tuples, xyz[2].tuples);
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_submit_points(tetlod_context *handle, const tetlod_array *xyz) {
  return entry(handle, [&](tetlod_context &context) {
    const StridedArray points = checked_source(xyz, {"points", 3, Shape::reals});
    context.input.xyz = {component(points, 0), component(points, 1), component(points, 2)};
  });
}

tetlod_status tetlod_submit_points_xyz(tetlod_context *handle, const tetlod_array *x, const tetlod_array *y,
                                       const tetlod_array *z) {
  return entry(handle, [&](tetlod_context &context) {
    const std::array<StridedArray, 3> xyz = {checked_source(x, {"x", 1, Shape::reals}),
                                             checked_source(y, {"y", 1, Shape::reals}),
                                             checked_source(z, {"z", 1, Shape::reals})};
    require_equal_lengths(xyz);
    context.input.xyz = xyz;
  });
}

tetlod_status tetlod_submit_tets(tetlod_context *handle, const tetlod_array *corners, int32_t index_base) {
  return entry(handle, [&](tetlod_context &context) {
    require_index_base(index_base);
    context.input.tets = checked_source(corners, {"tets", 4, Shape::integers});
    context.input.index_base = index_base;
  });
}

tetlod_status tetlod_submit_scalars(tetlod_context *handle, const char *name, const tetlod_array *values) {
  return entry(handle, [&](tetlod_context &context) {
    const StridedArray scalars = checked_source(values, {"scalars", 1, Shape::reals});
    std::string copy(name ? name : "");
    for (const SteeringField &field : context.input.steering)
      if (field.name == copy) fail(Status::argument, "scalars: field %.100s steers by this name already", name);
    context.input.scalars = scalars;
    context.input.scalars_name.swap(copy);
  });
}

tetlod_status tetlod_submit_point_flags(tetlod_context *handle, const tetlod_array *flags) {
  return entry(handle, [&](tetlod_context &context) {
    context.input.flags = checked_source(flags, {"flags", 1, Shape::bytes});
  });
}

tetlod_status tetlod_clear(tetlod_context *handle) {
  return entry(handle, [](tetlod_context &context) {
    context.input = Input{};
    context.prepared.forget(context.memory);
  });
}
