// The nearest point of a surface.
#pragma once

#include <vector>

#include "bench_mesh.hpp"
#include "box_tree.hpp"

namespace bench {

struct NearestPoint {
  Triangle triangle{};
  std::array<double, 3> weights{};  // barycentric
  double distance2 = Box::kInfinity;
};

class NearestTriangle {
 public:
  // Both must outlive it.
  NearestTriangle(const std::vector<Point> &points, const std::vector<Triangle> &triangles);
  NearestPoint nearest(const Point &p) const;

 private:
  void search(std::size_t at, const Point &p, NearestPoint &best) const;

  const std::vector<Point> &points_;
  const std::vector<Triangle> &triangles_;
  BoxTree tree_;
};

}  // namespace bench
