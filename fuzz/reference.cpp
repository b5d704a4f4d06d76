#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "predicates.hpp"

namespace fuzz {

namespace {

constexpr std::size_t face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

template <class Key>
Key sorted(Key key) {
  std::sort(key.begin(), key.end());
  return key;
}

Face face_of(const Corners &tet, std::size_t k) {
  return {tet[face_corners[k][0]], tet[face_corners[k][1]], tet[face_corners[k][2]]};
}

bool in_range(const Corners &tet, const Mesh &mesh) {
  return std::all_of(tet.begin(), tet.end(), [&](std::int64_t v) { return v >= 0 && v < mesh.point_count(); });
}

bool finite(const Point &p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

bool repeats(const Corners &tet) {
  const Corners order = sorted(tet);
  return std::adjacent_find(order.begin(), order.end()) != order.end();
}

using FaceUsers = std::map<Face, std::vector<std::size_t>>;

FaceUsers users_of(const std::vector<Corners> &tets, std::vector<bool> gone = {}) {
  FaceUsers users;
  gone.resize(tets.size(), false);
  for (std::size_t t = 0; t < tets.size(); t++)
    for (std::size_t k = 0; k < 4 && !gone[t]; k++) users[sorted(face_of(tets[t], k))].push_back(t);
  return users;
}

class Inspection {
 public:
  Inspection(const Mesh &mesh, const Repairs &repairs) : mesh_(mesh), repairs_(repairs) {}

  Facts inspect() {
    look_at_indices();
    look_at_points();
    look_at_range();
    merge();
    drop_repeated();
    drop_duplicates();
    look_at_tets();
    look_at_faces();
    if (facts_.nonmanifold_faces == 0) peel();
    look_at_values();
    return facts_;
  }

 private:
  const Point &at(std::int64_t v) const { return mesh_.points[std::size_t(v)]; }
  double value_of(std::int64_t v) const { return mesh_.values[std::size_t(v)]; }
  int side_of(const Corners &t) const { return side(at(t[0]), at(t[1]), at(t[2]), at(t[3])); }

  void look_at_indices() {
    used_.assign(mesh_.points.size(), false);
    named_ = used_;
    for (const Corners &tet : mesh_.tets) {
      for (const std::int64_t v : tet)
        if (v >= 0 && v < mesh_.point_count()) named_[std::size_t(v)] = true;
      if (!in_range(tet, mesh_)) {
        facts_.index++;
        continue;
      }
      tets_.push_back(tet);
      for (const std::int64_t v : tet) used_[std::size_t(v)] = true;
    }
  }

  void look_at_points() {
    for (std::size_t v = 0; v < used_.size(); v++) {
      if (!used_[v]) {
        facts_.unused += !named_[v];
      } else if (!finite(mesh_.points[v])) {
        facts_.nonfinite_points++;
        used_[v] = false;
      } else if (!std::isfinite(mesh_.values[v])) {
        facts_.nonfinite_values++;
        if (repairs_.drop_nonfinite) used_[v] = false;
      }
    }
  }

  void look_at_values() {
    for (const Corners &tet : facts_.nonmanifold_faces == 0 ? facts_.tets : tets_)
      for (const std::int64_t v : submitted_.at(sorted(tet))) facts_.values.add(value_of(v));
    for (std::size_t v = 0; v < used_.size(); v++)
      if (used_[v]) facts_.values_used.add(value_of(std::int64_t(v)));
  }

  /// Two used points that are not equal.
  bool any_near(double distance) const {
    std::vector<Point> points;
    for (std::size_t v = 0; v < used_.size(); v++)
      if (used_[v]) points.push_back(place(std::int64_t(v)));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (std::size_t i = 0; i < points.size(); i++)
      for (std::size_t j = i + 1; j < points.size() && points[j][0] - points[i][0] <= distance; j++)
        if (std::hypot(points[j][0] - points[i][0], points[j][1] - points[i][1], points[j][2] - points[i][2]) <=
            distance)
          return true;
    return false;
  }

  void look_at_range() {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t v = 0; v < used_.size(); v++)
      for (const double x : mesh_.points[v]) {
        if (!used_[v] || x == 0) continue;
        least = std::min(least, std::abs(x));
        most = std::max(most, std::abs(x));
      }
    facts_.wide = most * 1e-90 > least || any_near(4e-12 * most);
  }

  Point place(std::int64_t v) const {
    Point p = at(v);
    for (double &x : p) x += 0.0;  // -0 is 0
    return p;
  }

  void merge() {
    const auto has_all = [&](const Corners &t) {
      return std::all_of(t.begin(), t.end(), [&](std::int64_t v) { return used_[std::size_t(v)]; });
    };
    tets_.erase(std::remove_if(tets_.begin(), tets_.end(), [&](const Corners &t) { return !has_all(t); }), tets_.end());
    look_for_gaps(tets_by_place());
    look_for_torn_parts();
    const std::vector<std::int64_t> part = parts_of_points();
    std::map<std::pair<Point, std::int64_t>, std::int64_t> first;
    std::vector<std::int64_t> renamed(used_.size());
    for (std::size_t v = 0; v < used_.size(); v++) {
      if (!used_[v]) continue;
      renamed[v] = first.emplace(std::pair(place(std::int64_t(v)), part[v]), std::int64_t(v)).first->second;
      facts_.coincident += renamed[v] != std::int64_t(v);
    }
    for (Corners &tet : tets_) {
      const Corners submitted = tet;
      for (std::int64_t &v : tet) v = renamed[std::size_t(v)];
      submitted_.emplace(sorted(tet), submitted);
    }
  }

  /// The lowest point of the tets that hang together by points and, at the same places, faces; points of no
  /// tet that is left are parts of their own. All are one where contacts are not taken.
  std::vector<std::int64_t> parts_of_points() const {
    std::vector<std::int64_t> part(used_.size(), 0);
    if (!repairs_.takes_contacts) return part;
    std::iota(part.begin(), part.end(), 0);
    const auto root = [&](std::int64_t v) {
      while (part[std::size_t(v)] != v) v = part[std::size_t(v)];
      return v;
    };
    const auto join = [&](std::int64_t a, std::int64_t b) {
      part[std::size_t(std::max(root(a), root(b)))] = std::min(root(a), root(b));
    };
    std::map<std::array<Point, 3>, std::int64_t> first;
    for (const Corners &tet : tets_) {
      for (const std::int64_t v : tet) join(tet[0], v);
      for (std::size_t k = 0; k < 4 && !is_degenerate(tet); k++)
        join(tet[0], first.emplace(places(face_of(tet, k)), tet[0]).first->second);
    }
    for (std::size_t v = 0; v < part.size(); v++) part[v] = root(std::int64_t(v));
    return part;
  }

  /// Two, or the two sides of a crack, of as many tets as the library asks for, have points at one place.
  void look_for_torn_parts() {
    constexpr std::size_t fewest = 64;
    if (!repairs_.takes_contacts || tets_.size() < fewest) return;
    std::map<Point, std::int64_t> first;
    for (std::size_t v = 0; v < used_.size(); v++)
      facts_.gaps = facts_.gaps || (used_[v] && !first.emplace(place(std::int64_t(v)), std::int64_t(v)).second);
  }

  /// Degenerate ones have no faces: all their corners are one.
  std::vector<Corners> tets_by_place() const {
    std::map<Point, std::int64_t> first;
    for (std::size_t v = 0; v < used_.size(); v++)
      if (used_[v]) first.emplace(place(std::int64_t(v)), std::int64_t(v));
    std::vector<Corners> tets = tets_;
    for (Corners &tet : tets) {
      const bool degenerate = is_degenerate(tet);
      for (std::int64_t &v : tet) v = degenerate ? -1 : first.at(place(v));
    }
    return tets;
  }

  std::array<Point, 3> places(const Face &face) const {
    return sorted(std::array<Point, 3>{place(face[0]), place(face[1]), place(face[2])});
  }

  /// Two of its corners are at one place.
  bool is_degenerate(const Corners &tet) const {
    std::set<Point> corners;
    for (const std::int64_t v : tet) corners.insert(place(v));
    return corners.size() < 4;
  }

  void drop_repeated() {
    const auto end = std::remove_if(tets_.begin(), tets_.end(), repeats);
    facts_.repeated = tets_.end() - end;
    tets_.erase(end, tets_.end());
  }

  void drop_duplicates() {
    std::set<Corners> seen;
    const auto end =
        std::remove_if(tets_.begin(), tets_.end(), [&](const Corners &t) { return !seen.insert(sorted(t)).second; });
    facts_.duplicate = tets_.end() - end;
    tets_.erase(end, tets_.end());
  }

  void look_at_tets() {
    for (const Corners &tet : tets_) {
      facts_.flat += side_of(tet) == 0;
      facts_.inverted += side_of(tet) < 0;
    }
  }

  void look_at_faces() {
    for (const auto &[face, users] : users_of(tets_)) facts_.nonmanifold_faces += users.size() > 2;
  }

  /// Flat tets on the boundary cannot say which way is out: they go, until there are none.
  void peel() {
    std::vector<bool> gone(tets_.size(), false);
    for (bool again = true; again;) {
      again = false;
      for (const auto &[face, users] : users_of(tets_, gone))
        if (users.size() == 1 && !gone[users[0]] && side_of(tets_[users[0]]) == 0) again = gone[users[0]] = true;
    }
    for (std::size_t t = 0; t < tets_.size(); t++)
      if (!gone[t]) facts_.tets.push_back(tets_[t]);
    const FaceUsers users = users_of(facts_.tets);
    for (const Corners &tet : facts_.tets)
      for (std::size_t k = 0; k < 4; k++) {
        Face face = face_of(tet, k);
        if (users.at(sorted(face)).size() != 1) continue;
        if (side_of(tet) < 0) std::swap(face[1], face[2]);
        facts_.boundary.push_back(face);
      }
    look_for_gaps(facts_.tets);
  }

  void look_for_gaps(const std::vector<Corners> &tets) {
    if (!repairs_.takes_contacts && !repairs_.closes_gaps) return;
    const std::vector<Face> faces = single_faces(tets);
    facts_.gaps = facts_.gaps || any_hanging(faces) || any_quad(faces, tets);
  }

  static std::vector<Face> single_faces(const std::vector<Corners> &tets) {
    std::vector<Face> faces;
    for (const auto &[face, users] : users_of(tets))
      if (users.size() == 1 && face[0] >= 0) faces.push_back(face);
    return faces;
  }

  /// Two faces at an edge, and another with the other diagonal of their quad: the third and a fourth fill the quad, and
  /// are not of a tet with the two, or one is parallel to it.
  bool any_quad(const std::vector<Face> &faces, const std::vector<Corners> &tets) const {
    std::set<Corners> solid;
    for (const Corners &tet : tets) solid.insert(sorted(tet));
    std::map<std::array<std::int64_t, 2>, std::vector<Face>> at_edge;
    for (const Face &face : faces)
      for (std::size_t k = 0; k < 3; k++)
        at_edge[sorted(std::array<std::int64_t, 2>{face[k], face[(k + 1) % 3]})].push_back(face);
    const auto apex = [](const Face &face, const std::array<std::int64_t, 2> &edge) {
      return *std::find_if(face.begin(), face.end(), [&](std::int64_t v) { return v != edge[0] && v != edge[1]; });
    };
    for (const auto &[edge, around] : at_edge)
      for (const Face &one : around)
        for (const Face &two : around) {
          const std::int64_t u = apex(one, edge), v = apex(two, edge);
          const auto across = at_edge.find({u, v});
          if (u >= v || across == at_edge.end()) continue;
          std::size_t filling = 0;
          for (const Face &other : across->second) {
            if (are_parallel(one, other)) return true;
            const std::int64_t third = apex(other, across->first);
            filling += third == edge[0] || third == edge[1];
          }
          if (filling > 1 && !solid.count(sorted(Corners{edge[0], edge[1], u, v}))) return true;
        }
    return false;
  }

  std::array<double, 3> normal(const Face &face) const {
    std::array<double, 3> a, b;
    for (std::size_t i = 0; i < 3; i++) {
      a[i] = at(face[1])[i] - at(face[0])[i];
      b[i] = at(face[2])[i] - at(face[0])[i];
    }
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  bool are_parallel(const Face &one, const Face &other) const {
    const auto n = normal(one), m = normal(other);
    const double off = std::hypot(n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2], n[0] * m[1] - n[1] * m[0]);
    return !(off > 0.02 * std::hypot(n[0], n[1], n[2]) * std::hypot(m[0], m[1], m[2]));
  }

  /// Two edges from one vertex with the same direction.
  bool any_hanging(const std::vector<Face> &faces) const {
    double largest = 0;
    std::map<std::int64_t, std::set<std::int64_t>> edges;
    for (const Face &face : faces)
      for (std::size_t k = 0; k < 3; k++) {
        edges[face[k]].insert({face[(k + 1) % 3], face[(k + 2) % 3]});
        for (const double x : at(face[k])) largest = std::max(largest, std::abs(x));
      }
    for (const auto &[v, ends] : edges)
      for (const std::int64_t a : ends)
        for (const std::int64_t b : ends)
          if (a != b && has_one_direction(at(v), at(a), at(b), 1e-6 * largest)) return true;
    return false;
  }

  /// More or less: it does not matter where there are none.
  static bool has_one_direction(const Point &from, const Point &a, const Point &b, double rounding) {
    double u[3], w[3], dot = 0, uu = 0, ww = 0;
    for (std::size_t i = 0; i < 3; i++) {
      u[i] = a[i] - from[i];
      w[i] = b[i] - from[i];
      dot += u[i] * w[i];
      uu += u[i] * u[i];
      ww += w[i] * w[i];
    }
    const double off = std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]);
    return dot >= 0 && off <= std::min(rounding * std::sqrt(std::max(uu, ww)), 2e-3 * std::sqrt(uu * ww));
  }

  const Mesh &mesh_;
  const Repairs repairs_;
  Facts facts_;
  std::vector<bool> used_, named_;        // by a tet that counts; by any
  std::map<Corners, Corners> submitted_;  // of merged corners, the first that became these
  std::vector<Corners> tets_;
};

}  // namespace

Facts facts_of(const Mesh &mesh, const Repairs &repairs) { return Inspection(mesh, repairs).inspect(); }

Topology topology_of(const std::vector<Face> &faces) {
  Topology topology;
  std::map<std::int64_t, std::int64_t> parent;
  const auto root = [&](std::int64_t v) {
    while (parent.emplace(v, v).first->second != v) v = parent[v];
    return v;
  };
  std::map<std::array<std::int64_t, 2>, int> balance;
  for (const Face &face : faces)
    for (std::size_t k = 0; k < 3; k++) {
      const std::int64_t from = face[k], to = face[(k + 1) % 3];
      parent[root(from)] = root(to);
      balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  topology.points = std::int64_t(parent.size());
  topology.edges = std::int64_t(balance.size());
  topology.triangles = std::int64_t(faces.size());
  for (const auto &[edge, sum] : balance) topology.closed = topology.closed && sum == 0;
  for (const auto &[v, up] : parent) topology.components += v == up;
  return topology;
}

int side(const Point &a, const Point &b, const Point &c, const Point &d) {
  double most = 0;
  for (const Point &p : {a, b, c, d})
    for (const double x : p) most = std::max(most, std::abs(x));
  const int exponent = most > 0 ? -std::ilogb(most) : 0;
  const auto near_one = [&](const Point &p) {
    return tetlod::Vec3{std::ldexp(p[0], exponent), std::ldexp(p[1], exponent), std::ldexp(p[2], exponent)};
  };
  return tetlod::orientation(near_one(a), near_one(b), near_one(c), near_one(d));
}

}  // namespace fuzz
