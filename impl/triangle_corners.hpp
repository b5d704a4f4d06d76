// The corners of a surface's triangles, vertex by vertex.
#pragma once
#include <numeric>

#include "whole_arrays.hpp"

namespace tetlod {

/// Of a vertex in a triangle: the two others, in the triangle's order.
struct Corner {
  std::int32_t next, last, triangle;
};

class TriangleCorners {
 public:
  TriangleCorners(std::size_t vertices, Span<const Triangle> triangles, Job &job)
      : triangles_(triangles),
        begin_(vertices + 1, 0, &job.memory),
        corners_(3 * triangles.size(), Corner{}, &job.memory) {
    for (std::size_t i = 0; i < triangles.size(); i++) {
      job.poll_at(i, 0);
      for (const std::int32_t v : triangles[i]) begin_[std::size_t(v) + 1]++;
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    Array<std::uint32_t> place(begin_.begin(), begin_.end() - 1, &job.memory);
    for (std::size_t i = 0; i < triangles.size(); i++) {
      job.poll_at(i, 0);
      const Triangle &t = triangles[i];
      for (std::size_t k = 0; k < 3; k++)
        corners_[place[std::size_t(t[k])]++] = {t[(k + 1) % 3], t[(k + 2) % 3], std::int32_t(i)};
    }
  }
  Span<const Triangle> triangles() const { return triangles_; }
  /// None where there are very many: who looks at each with each would look long.
  Span<const Corner> of(std::int32_t v) const {
    constexpr std::size_t most = 256;
    const std::size_t begin = begin_[std::size_t(v)], count = begin_[std::size_t(v) + 1] - begin;
    return {corners_.data() + begin, count > most ? 0 : count};
  }

 private:
  Span<const Triangle> triangles_;
  Array<std::uint32_t> begin_;
  Array<Corner> corners_;
};

}  // namespace tetlod
