// What the judge says of a result.
#pragma once

#include "field_error.hpp"
#include "mesh_shape.hpp"

namespace bench {

struct Quality {
  FieldError field;
  double hausdorff;  // over the diagonal
  double volume;     // over the original's
  bool valid;
};

inline Quality measure_quality(const Mesh &original, const Shape &original_shape, const Mesh &result) {
  const Shape shape = shape_of(result);
  return {measure_field_error(original, result, shape.boundary), hausdorff(original, original_shape, result, shape),
          shape.volume / original_shape.volume, is_valid(original_shape, shape)};
}

}  // namespace bench
