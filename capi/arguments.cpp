#include "arguments.hpp"

#include <cinttypes>
#include <limits>

namespace tetlod::capi {

namespace {

constexpr std::size_t array_size = TETLOD_SIZE_TO(tetlod_array, data);

static_assert(std::int32_t(ElementType::int32) == TETLOD_INT32 && std::int32_t(ElementType::int64) == TETLOD_INT64, "");
static_assert(std::int32_t(ElementType::float32) == TETLOD_FLOAT32, "");
static_assert(std::int32_t(ElementType::float64) == TETLOD_FLOAT64, "");
static_assert(std::int32_t(ElementType::uint8) == TETLOD_UINT8, "");

std::int64_t alignment_of(ElementType type) {
  switch (type) {
    case ElementType::int32: return alignof(std::int32_t);
    case ElementType::int64: return alignof(std::int64_t);
    case ElementType::float32: return alignof(float);
    case ElementType::float64: return alignof(double);
    case ElementType::uint8: return 1;
  }
  return 1;
}

void require_type(const tetlod_array &array, const Shape &shape) {
  const bool reals = array.type == TETLOD_FLOAT32 || array.type == TETLOD_FLOAT64;
  const bool integers = array.type == TETLOD_INT32 || array.type == TETLOD_INT64;
  if (shape.kind == Shape::numbers && !reals && !integers && array.type != TETLOD_UINT8)
    fail(Status::argument, "%s: type %d is none of TETLOD_INT32 (1) to TETLOD_UINT8 (5)", shape.name, array.type);
  if (shape.kind == Shape::bytes && array.type != TETLOD_UINT8)
    fail(Status::argument, "%s: type %d is not TETLOD_UINT8 (5)", shape.name, array.type);
  if (shape.kind == Shape::reals && !reals)
    fail(Status::argument, "%s: type %d is neither TETLOD_FLOAT32 (3) nor TETLOD_FLOAT64 (4)", shape.name, array.type);
  if (shape.kind == Shape::integers && !integers)
    fail(Status::argument, "%s: type %d is neither TETLOD_INT32 (1) nor TETLOD_INT64 (2)", shape.name, array.type);
}

void require_components(const tetlod_array &array, const Shape &shape) {
  if (shape.components == Shape::any_number) {
    if (array.components < 1 || array.components > Shape::most_components)
      fail(Status::argument, "%s: %d components are not in [1, %d]", shape.name, array.components,
           Shape::most_components);
    return;
  }
  if (array.components != shape.components)
    fail(Status::argument, "%s: %d components, %d are needed", shape.name, array.components, shape.components);
}

void require_reserved(const tetlod_array &array, const Shape &shape) {
  if (array.reserved != 0) fail(Status::argument, "%s: reserved is %d, not 0", shape.name, array.reserved);
}

void require_count(const tetlod_array &array, const Shape &shape) {
  if (array.tuples < 0) fail(Status::argument, "%s: %" PRId64 " tuples", shape.name, array.tuples);
}

void require_manageable(const tetlod_array &array, const Shape &shape) {
  if (array.tuples > max_count)
    fail(Status::mesh_too_large, "%s: %" PRId64 " tuples, %" PRId64 " is the most", shape.name, array.tuples,
         max_count);
}

void require_data(const tetlod_array &array, const Shape &shape, std::int64_t alignment) {
  if (array.tuples == 0) return;
  if (!array.data) fail(Status::argument, "%s: data is NULL with %" PRId64 " tuples", shape.name, array.tuples);
  if (reinterpret_cast<std::uintptr_t>(array.data) % std::uintptr_t(alignment) != 0)
    fail(Status::argument, "%s: data %p is not a multiple of %" PRId64, shape.name, array.data, alignment);
}

void require_stride(std::int64_t stride, const char *which, const Shape &shape, std::int64_t alignment) {
  if (stride % alignment != 0)
    fail(Status::argument, "%s: %s %" PRId64 " is not a multiple of %" PRId64, shape.name, which, stride, alignment);
}

/// How far the elements reach before and beyond the first one, in bytes.
struct Reach {
  std::int64_t before = 0, beyond = 0;
  bool overflow = false;

  void add(std::int64_t steps, std::int64_t stride) {
    std::int64_t way;
    std::int64_t &side = stride < 0 ? before : beyond;
    overflow = overflow || __builtin_mul_overflow(steps, stride, &way) || __builtin_add_overflow(side, way, &side);
  }
};

Reach reach_of(const StridedArray &array) {
  Reach reach;
  reach.add(array.tuples - 1, array.tuple_stride);
  reach.add(array.components - 1, array.component_stride);
  reach.add(1, std::int64_t(element_size(array.type)));
  return reach;
}

/// Every byte that the array describes has an address.
void require_range(const StridedArray &array, const Shape &shape) {
  if (array.tuples == 0) return;
  const Reach reach = reach_of(array);
  const auto address = reinterpret_cast<std::uintptr_t>(array.data);
  const bool below = std::uint64_t(0) - std::uint64_t(reach.before) > address;
  const bool above = std::uint64_t(reach.beyond) > std::numeric_limits<std::uintptr_t>::max() - address;
  if (reach.overflow || below || above)
    fail(Status::argument,
         "%s: %" PRId64 " tuples with strides %" PRId64 " and %" PRId64 " go beyond the address space", shape.name,
         array.tuples, array.tuple_stride, array.component_stride);
}

/// No two elements in one place: c component strides are never as long as some tuple strides.
void require_apart(const StridedArray &array, const Shape &shape) {
  for (int c = 1; c < array.components; c++) {
    const std::int64_t way = c * array.component_stride;
    if (way % array.tuple_stride != 0) continue;
    const std::int64_t tuples = way / array.tuple_stride;
    if (tuples < array.tuples && -tuples < array.tuples)
      fail(Status::argument, "%s: with strides %" PRId64 " and %" PRId64 " elements share memory", shape.name,
           array.tuple_stride, array.component_stride);
  }
}

std::int64_t address(const StridedArray &array, int component) {
  return std::int64_t(reinterpret_cast<std::uintptr_t>(array.data)) + component * array.component_stride;
}

/// Whether some byte between the first and the last of one is between those of the other.
bool reach_each_other(const StridedArray &a, const StridedArray &b) {
  const Reach of_a = reach_of(a), of_b = reach_of(b);
  const std::int64_t way = address(b, 0) - address(a, 0);
  return way < of_a.beyond - of_b.before && -way < of_b.beyond - of_a.before;
}

/// Below zero, where every stride has one.
std::int64_t minus_length(std::int64_t stride) { return stride < 0 ? stride : -stride; }

/// With one tuple stride for both, to and fro: components are apart in each period of it.
bool are_interleaved(const StridedArray &a, const StridedArray &b) {
  const std::int64_t minus_period = minus_length(a.tuple_stride);
  if (minus_period != minus_length(b.tuple_stride)) return false;
  for (int i = 0; i < a.components; i++)
    for (int j = 0; j < b.components; j++) {
      std::int64_t rest = (address(b, j) - address(a, i)) % minus_period;
      if (rest < 0) rest -= minus_period;
      if (rest < std::int64_t(element_size(a.type)) || minus_period + rest > -std::int64_t(element_size(b.type)))
        return false;
    }
  return true;
}

StridedArray with_strides(const tetlod_array &array) {
  StridedArray result;
  result.type = ElementType(array.type);
  result.tuples = array.tuples;
  result.components = array.components;
  const auto size = std::int64_t(element_size(result.type));
  result.component_stride = array.component_stride ? array.component_stride : size;
  result.tuple_stride = array.tuple_stride ? array.tuple_stride : array.components * size;
  result.data = static_cast<unsigned char *>(array.data);
  result.present = true;
  return result;
}

void require_shape(const tetlod_array *array, const Shape &shape) {
  require_struct(array, shape.name, array_size);
  require_reserved(*array, shape);
  require_type(*array, shape);
  require_components(*array, shape);
  require_count(*array, shape);
}

StridedArray checked_layout(const tetlod_array &array, const Shape &shape) {
  const std::int64_t alignment = alignment_of(ElementType(array.type));
  require_data(array, shape, alignment);
  require_stride(array.tuple_stride, "tuple_stride", shape, alignment);
  require_stride(array.component_stride, "component_stride", shape, alignment);
  const StridedArray result = with_strides(array);
  require_range(result, shape);
  return result;
}

}  // namespace

void require_address(const void *pointer, std::size_t alignment, const char *name) {
  if (!pointer) fail(Status::argument, "%s is NULL", name);
  if (reinterpret_cast<std::uintptr_t>(pointer) % alignment != 0)
    fail(Status::argument, "%s %p is not a multiple of %zu", name, pointer, alignment);
}

void require_size(std::uint32_t struct_size, std::size_t least, const char *name) {
  if (struct_size < least) fail(Status::struct_size, "%s: struct_size is %u, at least %zu", name, struct_size, least);
}

void require_index_base(std::int32_t index_base) {
  if (index_base != 0 && index_base != 1) fail(Status::argument, "index_base %d is neither 0 nor 1", index_base);
}

StridedArray checked_source(const tetlod_array *array, const Shape &shape) {
  require_shape(array, shape);
  require_manageable(*array, shape);
  return checked_layout(*array, shape);
}

StridedArray checked_destination(const tetlod_array *array, const Shape &shape, std::size_t tuples) {
  require_shape(array, shape);
  if (array->tuples < std::int64_t(tuples))
    fail(Status::buffer_size, "%s: room for %" PRId64 " tuples, the result has %zu", shape.name, array->tuples, tuples);
  const StridedArray result = checked_layout(*array, shape);
  require_apart(result, shape);
  return result;
}

void require_memory_of_its_own(const StridedArray &to, const char *to_name, const StridedArray &from,
                               const char *from_name) {
  if (to.tuples > 0 && from.tuples > 0 && reach_each_other(to, from) && !are_interleaved(to, from))
    fail(Status::argument, "%s: shares memory with %s", to_name, from_name);
}

void require_view(const tetlod_array *array) { require_struct(array, "out", array_size); }

}  // namespace tetlod::capi
