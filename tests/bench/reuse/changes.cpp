#include "changes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "box_tree.hpp"

namespace bench {
namespace {

// Around the low corner.
double front(const Point &p, double radius, double steepness) {
  return std::tanh(steepness * (std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - radius));
}

// In [0, 1), another one at each place.
double noise(const Point &p) {
  std::uint64_t hash = 0;
  for (const double x : p) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return double(hash >> 11) * 0x1p-53;
}

}  // namespace

Change growing_wave(std::string name, double part, double along_x, double along_y) {
  return {std::move(name), [=](const Point &p, double first, int step) {
            return first + part * step * std::sin(along_x * p[0] + along_y * p[1]);
          }};
}

std::vector<Change> all_changes() {
  return {
      growing_wave("a wave grows slowly", 0.001),
      growing_wave("a wave grows", 0.03),
      growing_wave("a short wave grows", 0.01, 60, 50),
      {"the field fades",
       [](const Point &p, double first, int step) { return std::pow(0.6, step) * first + p[0] / 2; }},
      {"powers", [](const Point &, double first, int step) { return std::pow(first + 0.05, 1 - 0.15 * step); }},
      {"a front moves slowly", [](const Point &p, double, int step) { return front(p, 0.3 + 0.005 * step, 14); }},
      {"a front moves", [](const Point &p, double, int step) { return front(p, 0.3 + 0.05 * step, 14); }},
      {"a front gets smoother", [](const Point &p, double, int step) { return front(p, 0.4, 20 - 4 * step); }},
      {"a front gets sharper", [](const Point &p, double, int step) { return front(p, 0.4, 4 + 8 * step); }},
      {"noise vanishes",
       [](const Point &p, double, int step) { return std::pow(0.05, step) * noise(p) + front(p, 0.4, 5); }},
  };
}

ChangingMesh::ChangingMesh(Mesh mesh, Change change)
    : mesh_(std::move(mesh)), change_(std::move(change)), places_(mesh_.points), first_(mesh_.values) {
  const Box box = box_of(mesh_.points);
  const double diagonal = box.diagonal();
  const double least = *std::min_element(first_.begin(), first_.end()), range = range_of(first_);
  for (Point &p : places_)
    for (std::size_t k = 0; k < 3; k++) p[k] = (p[k] - box.low[k]) / diagonal;
  for (double &value : first_) value = (value - least) / range;
}

void ChangingMesh::go_to(int step) {
  for (std::size_t v = 0; v < places_.size(); v++) mesh_.values[v] = change_.value(places_[v], first_[v], step);
}

}  // namespace bench
