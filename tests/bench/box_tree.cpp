#include "box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bench {
namespace {

constexpr std::size_t kLeafItems = 8;

}  // namespace

void Box::add(const Point &p) {
  for (std::size_t a = 0; a < 3; a++) {
    low[a] = std::min(low[a], p[a]);
    high[a] = std::max(high[a], p[a]);
  }
}

void Box::add(const Box &other) {
  add(other.low);
  add(other.high);
}

bool Box::holds(const Point &p, double slack) const {
  for (std::size_t a = 0; a < 3; a++) {
    if (p[a] < low[a] - slack || p[a] > high[a] + slack) return false;
  }
  return true;
}

double Box::distance2(const Point &p) const {
  double sum = 0;
  for (std::size_t a = 0; a < 3; a++) {
    const double d = std::max({low[a] - p[a], 0.0, p[a] - high[a]});
    sum += d * d;
  }
  return sum;
}

double Box::diagonal() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }

std::size_t Box::longest_axis() const {
  std::size_t longest = 0;
  for (std::size_t a = 1; a < 3; a++) {
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  }
  return longest;
}

Box box_of(const std::vector<Point> &points) {
  Box box;
  for (const Point &p : points) box.add(p);
  return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) divide(0, order_.size());
}

std::size_t BoxTree::halve(std::size_t begin, std::size_t end, std::size_t axis) {
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto centre = [this, axis](std::size_t item) { return boxes_[item].low[axis] + boxes_[item].high[axis]; };
  std::nth_element(at(begin), at(middle), at(end),
                   [&centre](std::size_t s, std::size_t t) { return centre(s) < centre(t); });
  return middle;
}

std::size_t BoxTree::divide(std::size_t begin, std::size_t end) {
  const std::size_t self = nodes_.size();
  Box box;
  for (std::size_t i = begin; i < end; i++) box.add(boxes_[order_[i]]);
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeafItems) return self;
  const std::size_t middle = halve(begin, end, box.longest_axis());
  divide(begin, middle);
  const std::size_t right = divide(middle, end);
  nodes_[self].right = right;
  return self;
}

}  // namespace bench
