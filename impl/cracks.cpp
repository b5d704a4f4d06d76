#include "cracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "face_sweep.hpp"
#include "field_jumps.hpp"
#include "geometry.hpp"
#include "triangle_corners.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Of the boundary as submitted.
struct Face {
  Triangle points;  ///< counter-clockwise seen from outside
  std::int32_t tet;
};

/// Two faces that lie on one another at an edge, one of whose ends at least both have a point of their own at.
struct Pair {
  std::array<std::int32_t, 2> face;
  std::array<std::pair<std::int32_t, std::int32_t>, 2> end;  ///< the points of the one and of the other
  bool is_crack = false;
};

/// A way that leads along each of these normals by 1 or more, and is at most twice as long as the shortest such; 0: it
/// would be longer than that.
Vec3 way_along(Span<const Vec3> normals, double longest) {
  constexpr int most_steps = 1000;
  constexpr double enough = 0.5;
  Vec3 nearest = normals[0];  // to the origin, in the convex hull
  for (int step = 0; step < most_steps; step++) {
    const Vec3 &last = *std::min_element(normals.begin(), normals.end(), [&](const Vec3 &a, const Vec3 &b) {
      return glm::dot(a, nearest) < glm::dot(b, nearest);
    });
    const double length = glm::length(nearest), lean = length > 0 ? glm::dot(last, nearest) / length : 0;
    if (longest * lean >= 1 && lean >= enough * length) return nearest / (lean * length);
    if (longest * length < 1) break;  // as the others would
    const Vec3 way = last - nearest;
    nearest += std::clamp(-glm::dot(nearest, way) / length2(way), 0.0, 1.0) * way;
  }
  return Vec3(0);
}

class CracksOfMesh {
 public:
  CracksOfMesh(const SubmittedMesh &mesh, Job &job, Array<std::int32_t> &representative)
      : mesh_(mesh),
        job_(job),
        representative_(representative),
        place_(representative.begin(), representative.end(), &job.memory),
        faces_(&job.memory),
        pairs_(&job.memory),
        cracks_(representative.size(), job.memory),
        is_at_crack_(representative.size(), 0, &job.memory) {}

  Cracks keep_open(const Opening &opening) {
    Cracks found(job_.memory);
    find_faces();
    if (faces_.empty()) return found;
    find_pairs();
    if (!are_between_large_pieces()) return found;
    join_cracks();
    if (any_jumps(found)) {
      split_places();
      open(opening, found);
    }
    return found;
  }

 private:
  const Vec3 &at(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  std::int32_t place(std::int32_t v) const { return place_[std::size_t(v)]; }

  bool is_usable(const Tet &t) const { return !has_repeated_vertex(t) && mesh_.has_all(t); }

  /// visit(first, last) of the uses of each face; excluded: of each tet.
  template <class Visit>
  void for_faces(Span<const std::uint8_t> excluded, const Visit &visit) const {
    for_each_face(without_fields(mesh_.points, mesh_.tets), excluded, job_, visit);
  }

  /// Of each point, how many are at its place.
  Array<std::int32_t> count_points_of_large_parts() const {
    DisjointSets parts = mesh_.join_parts(job_);
    Array<std::int32_t> tets(place_.size(), 0, &job_.memory), points(place_.size(), 0, &job_.memory);
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      job_.poll_at(t, 0.9);
      if (is_usable(mesh_.tets[t])) tets[std::size_t(parts.lowest(mesh_.tets[t][0]))]++;
    }
    for (std::size_t v = 0; v < place_.size(); v++)
      points[std::size_t(place_[v])] += tets[std::size_t(parts.lowest(std::int32_t(v)))] >= large_part;
    for (std::size_t v = 0; v < place_.size(); v++) points[v] = points[std::size_t(place_[v])];
    return points;
  }

  /// Those at places of several points of large parts, or smaller ones that are there, too.
  void find_faces() {
    const Array<std::int32_t> points = count_points_of_large_parts();
    if (std::all_of(points.begin(), points.end(), [](std::int32_t count) { return count < 2; })) return;
    const auto any_doubled = [&](const auto &simplex) {
      return std::any_of(simplex.begin(), simplex.end(), [&](std::int32_t v) { return points[std::size_t(v)] > 1; });
    };
    Array<std::uint8_t> excluded(&job_.memory);
    excluded.reserve(mesh_.tets.size());
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      job_.poll_at(t, 0.9);
      excluded.push_back(!any_doubled(mesh_.tets[t]) || !is_usable(mesh_.tets[t]));
    }
    for_faces(excluded, [&](const FaceUse *first, const FaceUse *last) {
      if (last - first > 1) return;
      const Face face = face_of(*first);
      if (any_doubled(face.points)) faces_.push_back(face);
    });
  }

  Face face_of(const FaceUse &use) const {
    const Tet &t = mesh_.tets[use.tet()];
    Triangle points = face_opposite(t, use.corner());
    if (six_volume(mesh_.points, t) < 0) std::swap(points[1], points[2]);
    return {points, std::int32_t(use.tet())};
  }

  Vec3 outward(const Triangle &t) const { return area_vector(mesh_.points, t); }

  /// The same triangles where hexahedra were split in one way on both sides, others that cross them where not.
  void find_pairs() {
    Array<Triangle> at_places = array_of(faces_.size(), Triangle(), job_);
    for_each(faces_.size(), job_, [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; k++) at_places[i][k] = place(faces_[i].points[k]);
    });
    const TriangleCorners corners(place_.size(), at_places, job_);
    for (std::size_t v = 0; v < place_.size(); v++) {
      job_.poll_at(v, 0.9);
      const Span<const Corner> here = corners.of(std::int32_t(v));
      for (const Corner &one : here)
        for (const Corner &other : here)
          if (one.next == other.last && std::int32_t(v) < one.next)
            add_if_back_to_back(one.triangle, other.triangle, {std::int32_t(v), one.next});
    }
  }

  void add_if_back_to_back(std::int32_t one, std::int32_t other, const std::array<std::int32_t, 2> &places) {
    constexpr double least_cosine = 0.9;
    const Triangle &s = faces_[std::size_t(one)].points, &t = faces_[std::size_t(other)].points;
    Pair pair{{one, other}, {}};
    for (std::size_t k = 0; k < 2; k++) pair.end[k] = {point_at(s, places[k]), point_at(t, places[k])};
    const bool is_doubled = pair.end[0].first != pair.end[0].second || pair.end[1].first != pair.end[1].second;
    const Vec3 m = outward(s), n = outward(t);
    if (is_doubled && glm::dot(m, n) < -least_cosine * glm::length(m) * glm::length(n) && !is_between(pair, m))
      pairs_.push_back(pair);
  }

  /// Whether it is material that lies between, as of a plate whose faces are one within the tolerance.
  bool is_between(const Pair &pair, const Vec3 &outward_of_one) const {
    return std::any_of(pair.end.begin(), pair.end.end(), [&](const auto &end) {
      constexpr double rounding = 1e-6;  // of the face
      const double thick = glm::dot(at(end.first) - at(end.second), outward_of_one), area = glm::length(outward_of_one);
      return thick > rounding * area * std::sqrt(area);
    });
  }

  std::int32_t point_at(const Triangle &t, std::int32_t of_place) const {
    return *std::find_if(t.begin(), t.end(), [&](std::int32_t v) { return place(v) == of_place; });
  }

  /// Of tets that have faces in common as they were submitted. True: some are, and may be cracks.
  bool are_between_large_pieces() {
    if (pairs_.empty()) return false;
    Array<std::uint8_t> excluded = array_of(mesh_.tets.size(), std::uint8_t(0), job_);
    for_each(excluded.size(), job_, [&](std::size_t t) { excluded[t] = !is_usable(mesh_.tets[t]); });
    DisjointSets pieces(mesh_.tets.size(), job_.memory);
    for_faces(excluded, [&](const FaceUse *first, const FaceUse *last) {
      for (const FaceUse *use = first + 1; use < last; use++)
        pieces.join(std::int32_t(first->tet()), std::int32_t(use->tet()));
    });
    Array<std::int32_t> count(mesh_.tets.size(), 0, &job_.memory);
    for (std::size_t t = 0; t < count.size(); t++) {
      job_.poll_at(t, 0.9);
      count[std::size_t(pieces.lowest(std::int32_t(t)))]++;
    }
    bool any = false;
    for (Pair &pair : pairs_) {
      pair.is_crack = std::all_of(pair.face.begin(), pair.face.end(), [&](std::int32_t face) {
        return count[std::size_t(pieces.lowest(faces_[std::size_t(face)].tet))] >= large_part;
      });
      any |= pair.is_crack;
    }
    return any;
  }

  /// visit(v, u): two points at one place.
  template <class Visit>
  static void for_doubled(const Pair &pair, const Visit &visit) {
    for (const auto &[v, u] : pair.end)
      if (v != u) visit(v, u);
  }

  /// Pairs hang together at places where both have two points.
  void join_cracks() {
    for (const Pair &pair : pairs_)
      if (pair.is_crack && pair.end[0].first != pair.end[0].second && pair.end[1].first != pair.end[1].second)
        cracks_.join(place(pair.end[0].first), place(pair.end[1].first));
  }

  /// Known by its lowest place.
  std::size_t of_crack(std::int32_t v) { return std::size_t(cracks_.lowest(place(v))); }

  /// Those across which no field does are none, unless it does beside them.
  bool any_jumps(Cracks &found) {
    FieldJumps fields(mesh_.input, mesh_.used, job_);
    Array<std::uint8_t> jumps(place_.size(), 0, &job_.memory);  // of each crack
    for (const Pair &pair : pairs_)
      if (pair.is_crack)
        for_doubled(pair, [&](std::int32_t v, std::int32_t u) { jumps[of_crack(v)] |= fields.ask(v, u); });
    found.asked = std::move(fields).asked();
    bool any = false;
    for (Pair &pair : pairs_) {
      if (!pair.is_crack) continue;
      for_doubled(pair, [&](std::int32_t v, std::int32_t) {
        pair.is_crack = jumps[of_crack(v)] != 0;
        is_at_crack_[std::size_t(place(v))] = pair.is_crack;
      });
      any |= pair.is_crack;
    }
    return any;
  }

  /// Each side's lowest point stands for it.
  void split_places() {
    DisjointSets side(place_.size(), job_.memory);
    for (const Pair &pair : pairs_)
      if (!pair.is_crack) for_doubled(pair, [&](std::int32_t v, std::int32_t u) { side.join(v, u); });
    for (std::size_t v = 0; v < place_.size(); v++)
      if (is_at_crack_[std::size_t(place_[v])]) representative_[v] = side.lowest(std::int32_t(v));
  }

  /// A point that stands for a side, and a face of the crack, not at the crack's front there.
  using PointAndFace = std::pair<std::int32_t, std::int32_t>;

  Array<PointAndFace> faces_of_sides() const {
    Array<PointAndFace> faces(&job_.memory);
    for (const Pair &pair : pairs_)
      for (const auto &[v, u] : pair.end) {
        const std::int32_t one = representative_[std::size_t(v)], other = representative_[std::size_t(u)];
        if (!pair.is_crack || one == other) continue;
        faces.push_back({one, pair.face[0]});
        faces.push_back({other, pair.face[1]});
      }
    std::sort(faces.begin(), faces.end(), PollingLess(job_, 0.9, std::less<PointAndFace>()));
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  void open(const Opening &opening, Cracks &found) {
    Array<std::uint8_t> is_closed(place_.size(), opening.made != nullptr, &job_.memory);  // of each crack
    if (opening.made)
      for (const Move &move : *opening.made) {
        if (!is_at_crack_[std::size_t(place(move.vertex))]) continue;
        is_closed[of_crack(move.vertex)] = 0;
        found.opened.push_back(move);
      }
    else
      find_ways_back(opening, is_closed, found);
    close(is_closed, found);
  }

  /// Of each side into its own.
  void find_ways_back(const Opening &opening, Array<std::uint8_t> &is_closed, Cracks &found) {
    const Array<PointAndFace> faces = faces_of_sides();
    const Array<std::uint8_t> flagged = find_flagged();
    const Array<double> room = find_room();
    Array<std::int32_t> stay(place_.size(), 0, &job_.memory);  // of each place, how many sides do
    for (std::size_t first = 0, last = 0; first < faces.size(); first = last) {
      const auto v = std::size_t(faces[first].first);
      while (last < faces.size() && faces[last].first == faces[first].first) last++;
      const Vec3 way = flagged[v] ? Vec3(0) : way_back({faces.data() + first, last - first}, opening.by, room[v]);
      if (way == Vec3(0))
        stay[std::size_t(place_[v])]++;
      else
        found.opened.push_back({std::int32_t(v), mesh_.points[v] + way});
      if (stay[std::size_t(place_[v])] > 1 || glm::length(way) > opening.most) is_closed[of_crack(std::int32_t(v))] = 1;
    }
    const auto used = std::size_t(std::count(mesh_.used.begin(), mesh_.used.end(), 1));
    if (2 * found.opened.size() > used) std::fill(is_closed.begin(), is_closed.end(), std::uint8_t(1));
  }

  /// From each face by so much, or by a tenth of that at least, where there is no room for more; 0: there is no such
  /// way.
  Vec3 way_back(Span<const PointAndFace> of_faces, double by, double room) const {
    Array<Vec3> normals(&job_.memory);
    for (const PointAndFace &of : of_faces) {
      const Vec3 normal = outward(faces_[std::size_t(of.second)].points);
      normals.push_back(normal / glm::length(normal));  // it lies back to back on another
    }
    const Vec3 way = way_along(normals, longest);
    const double far = std::min(by, part_of_room * room / glm::length(way));
    return far < 0.1 * by ? Vec3(0) : -far * way;
  }

  /// Of each point that stands for a side, the least height of a tet over the face that it has not.
  Array<double> find_room() const {
    Array<double> room = array_of(place_.size(), std::numeric_limits<double>::infinity(), job_);
    const auto is_at_crack = [&](std::int32_t v) { return is_at_crack_[std::size_t(place(v))] != 0; };
    for (std::size_t i = 0; i < mesh_.tets.size(); i++) {
      job_.poll_at(i, 0.9);
      const Tet &t = mesh_.tets[i];
      if (std::none_of(t.begin(), t.end(), is_at_crack) || !is_usable(t)) continue;
      const double six_volumes = std::abs(six_volume(mesh_.points, t));
      for (std::size_t k = 0; k < 4; k++) {
        double &least = room[std::size_t(representative_[std::size_t(t[k])])];
        least = std::min(least, six_volumes / glm::length(area_vector(mesh_.points, face_opposite(t, k))));
      }
    }
    return room;
  }

  /// The sides of such cracks become one again.
  void close(Span<const std::uint8_t> is_closed, Cracks &found) {
    for (std::size_t v = 0; v < place_.size(); v++)
      if (is_closed[of_crack(std::int32_t(v))]) representative_[v] = place_[v];
    const auto is_at_closed = [&](const Move &move) { return is_closed[of_crack(move.vertex)] != 0; };
    found.opened.erase(std::remove_if(found.opened.begin(), found.opened.end(), is_at_closed), found.opened.end());
  }

  /// Of each point that stands for others, too, whether the host flags one of them.
  Array<std::uint8_t> find_flagged() const {
    Array<std::uint8_t> flagged(representative_.size(), 0, &job_.memory);
    for (std::size_t v = 0; v < flagged.size() && std::int64_t(v) < mesh_.input.flags.tuples; v++)
      if (mesh_.input.flags.at<std::uint8_t>(std::int64_t(v), 0)) flagged[std::size_t(representative_[v])] = 1;
    return flagged;
  }

  /// Way back, beside what it leads from each of the faces.
  static constexpr double longest = 20;
  /// So that no tet turns over, though all of its corners move.
  static constexpr double part_of_room = 0.05;

  const SubmittedMesh &mesh_;
  Job &job_;
  Array<std::int32_t> &representative_;
  Array<std::int32_t> place_;  // of each point, as the lowest one there
  Array<Face> faces_;
  Array<Pair> pairs_;
  DisjointSets cracks_;              // of places
  Array<std::uint8_t> is_at_crack_;  // of each place
};

}  // namespace

Cracks keep_cracks_open(const SubmittedMesh &mesh, const Opening &opening, Job &job,
                        Array<std::int32_t> &representative) {
  return CracksOfMesh(mesh, job, representative).keep_open(opening);
}

}  // namespace tetlod
