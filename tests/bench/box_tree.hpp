// Items in the order of a balanced tree over the boxes of its halves.
#pragma once

#include <limits>
#include <vector>

#include "bench_mesh.hpp"

namespace bench {

struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Point &p);
  void add(const Box &other);
  bool holds(const Point &p, double slack) const;
  double distance2(const Point &p) const;
  double diagonal() const;
  std::size_t longest_axis() const;
};

Box box_of(const std::vector<Point> &points);

template <std::size_t corners>
Box box_of(const std::vector<Point> &points, const std::array<std::int32_t, corners> &simplex) {
  Box box;
  for (const std::int32_t corner : simplex) box.add(points[std::size_t(corner)]);
  return box;
}

class BoxTree {
 public:
  struct Node {
    Box box;
    std::size_t begin, end;  // in order()
    std::size_t right;       // 0: a leaf; the left half is the next node
  };

  explicit BoxTree(std::vector<Box> boxes);
  // Empty for no items; the root is the first.
  const std::vector<Node> &nodes() const { return nodes_; }
  const std::vector<std::size_t> &order() const { return order_; }

 private:
  std::size_t divide(std::size_t begin, std::size_t end);
  std::size_t halve(std::size_t begin, std::size_t end, std::size_t axis);

  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace bench
