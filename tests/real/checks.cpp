#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace real_test {

namespace {

using Face = std::array<std::int32_t, 3>;

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double determinant(const Point &a, const Point &b, const Point &c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Six times the volume.
double six_volumes(const std::vector<Point> &points, const Tet &t) {
  const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
  return determinant(minus(at(1), at(0)), minus(at(2), at(0)), minus(at(3), at(0)));
}

bool has_no_volume(const TetFile &mesh, const Tet &t) {
  double longest = 0;
  for (std::size_t k = 1; k < 4; k++) {
    const Point e = minus(mesh.points[std::size_t(t[k])], mesh.points[std::size_t(t[0])]);
    longest = std::max(longest, std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]));
  }
  return std::abs(six_volumes(mesh.points, t)) <= 1e-15 * longest * longest * longest;
}

struct FaceUse {
  Face sorted;
  Face outward;
  bool operator<(const FaceUse &o) const { return sorted < o.sorted; }
};

/// The faces of a tet, outward; a tet of negative volume is taken the other way round.
void add_faces(const TetFile &mesh, const Tet &t, std::vector<FaceUse> &faces) {
  Tet positive = t;
  if (six_volumes(mesh.points, t) < 0) std::swap(positive[0], positive[1]);
  const auto [a, b, c, d] = positive;
  for (const Face &f : {Face{a, c, b}, Face{a, b, d}, Face{b, c, d}, Face{c, a, d}}) {
    Face sorted = f;
    std::sort(sorted.begin(), sorted.end());
    faces.push_back({sorted, f});
  }
}

bool same_winding(const Face &a, const Face &b) {
  for (std::size_t turn = 0; turn < 3; turn++)
    if (a[0] == b[turn] && a[1] == b[(turn + 1) % 3] && a[2] == b[(turn + 2) % 3]) return true;
  return false;
}

std::vector<Face> boundary_of(const TetFile &mesh, Facts &facts) {
  std::vector<FaceUse> faces;
  for (const Tet &t : mesh.tets) add_faces(mesh, t, faces);
  std::sort(faces.begin(), faces.end());
  std::vector<Face> boundary;
  for (std::size_t i = 0, j; i < faces.size(); i = j) {
    for (j = i + 1; j < faces.size() && faces[j].sorted == faces[i].sorted;) j++;
    if (j - i == 1) boundary.push_back(faces[i].outward);
    facts.over_shared += j - i > 2;
    facts.folded += j - i == 2 && same_winding(faces[i].outward, faces[i + 1].outward);
  }
  return boundary;
}

void look_at_boundary(const TetFile &mesh, const std::vector<Face> &boundary, Facts &facts) {
  struct Side {
    std::int32_t low, high;
    bool up;
    bool operator<(const Side &o) const { return low != o.low ? low < o.low : high < o.high; }
  };
  std::vector<Side> sides;
  std::vector<std::int32_t> parent(mesh.points.size(), -1);  // of vertices on the boundary
  const auto root = [&](std::int32_t v) {
    while (parent[std::size_t(v)] != v) v = parent[std::size_t(v)] = parent[std::size_t(parent[std::size_t(v)])];
    return v;
  };
  for (const Face &f : boundary) {
    for (std::int32_t v : f)
      if (parent[std::size_t(v)] < 0) parent[std::size_t(v)] = v;
    for (std::size_t k = 0; k < 3; k++) {
      const std::int32_t a = f[k], b = f[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b});
      parent[std::size_t(root(a))] = root(b);
    }
    facts.boundary_volume += determinant(minus(mesh.points[std::size_t(f[0])], mesh.points[0]),
                                         minus(mesh.points[std::size_t(f[1])], mesh.points[0]),
                                         minus(mesh.points[std::size_t(f[2])], mesh.points[0])) /
                             6;
  }
  std::sort(sides.begin(), sides.end());
  std::int64_t edges = 0, vertices = 0;
  for (std::size_t i = 0, j; i < sides.size(); i = j) {
    std::int64_t up = 0;
    for (j = i; j < sides.size() && !(sides[i] < sides[j]); j++) up += sides[j].up;
    edges++;
    facts.open_edges += 2 * up != std::int64_t(j - i);
    facts.nonmanifold_edges += j - i > 2;
  }
  for (std::size_t v = 0; v < parent.size(); v++) {
    vertices += parent[v] >= 0;
    facts.components += parent[v] == std::int32_t(v);
  }
  facts.euler = vertices - edges + std::int64_t(boundary.size());
  facts.boundary_triangles = std::int64_t(boundary.size());
}

/// Tets by the cells of a grid that their boxes meet.
class Grid {
 public:
  explicit Grid(const TetFile &mesh) : mesh_(mesh), low_(mesh.points[0]), high_(low_) {
    for (const Point &p : mesh.points)
      for (std::size_t k = 0; k < 3; k++) {
        low_[k] = std::min(low_[k], p[k]);
        high_[k] = std::max(high_[k], p[k]);
      }
    size_ = std::max(1, int(std::cbrt(double(mesh.tets.size()))));
    cells_.resize(std::size_t(size_ * size_ * size_));
    for (std::size_t t = 0; t < mesh.tets.size(); t++) insert(std::int32_t(t));
  }

  bool value_at(const Point &p, double &value) const {
    double best = -1e-6;  // a barycentric weight that rounding may leave
    bool found = false;
    for (std::size_t k = 0; k < 3; k++)
      if (p[k] < low_[k] || p[k] > high_[k]) return false;
    for (std::int32_t t : cells_[cell(index(p, 0), index(p, 1), index(p, 2))]) {
      double w[4];
      weights(mesh_.tets[std::size_t(t)], p, w);
      const double least = *std::min_element(w, w + 4);
      if (least <= best) continue;
      best = least;
      found = true;
      value = 0;
      for (std::size_t k = 0; k < 4; k++) value += w[k] * mesh_.scalars[std::size_t(mesh_.tets[std::size_t(t)][k])];
    }
    return found;
  }

 private:
  int index(const Point &p, std::size_t k) const {
    const double extent = high_[k] - low_[k];
    return extent > 0 ? std::clamp(int(double(size_) * (p[k] - low_[k]) / extent), 0, size_ - 1) : 0;
  }
  std::size_t cell(int x, int y, int z) const { return std::size_t((x * size_ + y) * size_ + z); }

  void insert(std::int32_t t) {
    Point low = mesh_.points[std::size_t(mesh_.tets[std::size_t(t)][0])], high = low;
    for (std::int32_t v : mesh_.tets[std::size_t(t)])
      for (std::size_t k = 0; k < 3; k++) {
        low[k] = std::min(low[k], mesh_.points[std::size_t(v)][k]);
        high[k] = std::max(high[k], mesh_.points[std::size_t(v)][k]);
      }
    for (int x = index(low, 0); x <= index(high, 0); x++)
      for (int y = index(low, 1); y <= index(high, 1); y++)
        for (int z = index(low, 2); z <= index(high, 2); z++) cells_[cell(x, y, z)].push_back(t);
  }

  void weights(const Tet &t, const Point &p, double w[4]) const {
    const auto from_p = [&](std::size_t k) { return minus(mesh_.points[std::size_t(t[k])], p); };
    const Point a = from_p(0), b = from_p(1), c = from_p(2), d = from_p(3);
    w[0] = -determinant(b, c, d);
    w[1] = determinant(a, c, d);
    w[2] = -determinant(a, b, d);
    w[3] = determinant(a, b, c);
    const double whole = w[0] + w[1] + w[2] + w[3];
    for (std::size_t k = 0; k < 4; k++) w[k] /= whole;
  }

  const TetFile &mesh_;
  Point low_, high_;
  int size_ = 1;
  std::vector<std::vector<std::int32_t>> cells_;
};

}  // namespace

TetFile repaired(const TetFile &mesh) {
  TetFile result;
  result.points = mesh.points;
  result.scalars = mesh.scalars;
  std::map<Point, std::int32_t> first;
  std::vector<std::int32_t> joined;
  for (std::size_t v = 0; v < mesh.points.size(); v++)
    joined.push_back(first.emplace(mesh.points[v], std::int32_t(v)).first->second);
  for (Tet t : mesh.tets) {
    for (std::int32_t &v : t) v = joined[std::size_t(v)];
    Tet sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
    if (!has_no_volume(mesh, t)) result.tets.push_back(t);
  }
  return result;
}

Facts facts_of(const TetFile &mesh) {
  Facts facts;
  std::vector<bool> used(mesh.points.size(), false);
  for (const Tet &t : mesh.tets) {
    const double volume = six_volumes(mesh.points, t) / 6;
    facts.not_positive += !(volume > 0);
    facts.volume += std::abs(volume);
    for (std::int32_t v : t) used[std::size_t(v)] = true;
  }
  facts.unused = std::count(used.begin(), used.end(), false);
  look_at_boundary(mesh, boundary_of(mesh, facts), facts);
  return facts;
}

FieldError field_error(const TetFile &original, const TetFile &result) {
  const Grid grid(result);
  const auto [low, high] = std::minmax_element(original.scalars.begin(), original.scalars.end());
  double squares = 0;
  std::int64_t inside = 0;
  for (std::size_t v = 0; v < original.points.size(); v++) {
    double value;
    if (!grid.value_at(original.points[v], value)) continue;
    squares += (value - original.scalars[v]) * (value - original.scalars[v]);
    inside++;
  }
  const double count = double(original.points.size());
  return {std::sqrt(squares / double(std::max<std::int64_t>(inside, 1))) / (*high - *low), 1 - double(inside) / count};
}

}  // namespace real_test
