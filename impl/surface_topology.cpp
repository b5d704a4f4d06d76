#include "surface_topology.hpp"

#include <algorithm>

#include "predicates.hpp"
#include "status.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

constexpr int next(int k) { return k == 2 ? 0 : k + 1; }

class TopologyFinder {
 public:
  TopologyFinder(Span<const Vec3> points, Span<const Triangle> triangles, const HostNumbers &numbers, Job &job,
                 SurfaceTopology &out)
      : points_(points), triangles_(triangles), numbers_(numbers), job_(job), out_(out) {}

  void find() {
    sort_half_edges();
    out_.mate.assign(3 * triangles_.size(), -1);
    out_.touching.assign(points_.size(), 0);
    pair_half_edges();
    find_sheet_vertices();
    find_components();
  }

 private:
  struct HalfEdge {
    std::int32_t high, id;  // the end with the higher number; 3 t + k
  };

  std::int32_t from(std::int32_t h) const { return triangles_[std::size_t(h / 3)][std::size_t(h % 3)]; }
  std::int32_t to(std::int32_t h) const { return triangles_[std::size_t(h / 3)][std::size_t(next(h % 3))]; }
  std::int32_t apex(std::int32_t h) const { return triangles_[std::size_t(h / 3)][std::size_t(next(next(h % 3)))]; }
  std::int32_t low_end(std::int32_t h) const { return std::min(from(h), to(h)); }
  bool runs_up(std::int32_t h) const { return from(h) < to(h); }

  /// A counting sort by the lower end, then each small bucket by the higher one.
  void sort_half_edges() {
    begin_.assign(points_.size() + 1, 0);
    const auto count = std::int32_t(3 * triangles_.size());
    for (std::int32_t h = 0; h < count; h++) {
      job_.poll_at(std::size_t(h), 0);
      begin_[std::size_t(low_end(h)) + 1]++;
    }
    for (std::size_t v = 0; v < points_.size(); v++) begin_[v + 1] += begin_[v];
    sorted_.resize(std::size_t(count));
    Array<std::int32_t> place(begin_, &job_.memory);
    for (std::int32_t h = 0; h < count; h++) {
      job_.poll_at(std::size_t(h), 0);
      sorted_[std::size_t(place[std::size_t(low_end(h))]++)] = {std::max(from(h), to(h)), h};
    }
    for_each(points_.size(), job_, [&](std::size_t v) {
      std::sort(sorted_.begin() + begin_[v], sorted_.begin() + begin_[v + 1],
                [](const HalfEdge &a, const HalfEdge &b) { return a.high != b.high ? a.high < b.high : a.id < b.id; });
    });
  }

  /// Edges of some points: how many, and how many of them are not simply two half-edges that run against each other.
  struct Count {
    std::int64_t all = 0, others = 0;
  };

  /// The few that are no simple ones come one after another, so that what is told of is the first.
  void pair_half_edges() {
    const Array<Count> parts = parts_of(points_.size(), Count(), job_, [&](Count &count, std::size_t v) {
      for_edges_at(v, [&](std::size_t begin, std::size_t end) {
        const bool simple = is_simple(begin, end);
        if (simple) pair(sorted_[begin].id, sorted_[begin + 1].id);
        count.all++;
        count.others += !simple;
      });
    });
    for (std::size_t i = 0; i < parts.size(); i++) {
      job_.poll(0);
      out_.edges += parts[i].all;
      const std::size_t end = parts[i].others > 0 ? std::min((i + 1) * stretch, points_.size()) : 0;
      for (std::size_t v = i * stretch; v < end; v++)
        for_edges_at(v, [&](std::size_t first, std::size_t last) {
          if (!is_simple(first, last)) pair_around_edge(first, last);
        });
    }
  }

  /// visit(begin, end) of the half-edges between v and each higher point.
  template <class Visit>
  void for_edges_at(std::size_t v, const Visit &visit) const {
    const auto last = std::size_t(begin_[v + 1]);
    for (std::size_t i = std::size_t(begin_[v]), j = i; i < last; i = j) {
      while (j < last && sorted_[j].high == sorted_[i].high) j++;
      visit(i, j);
    }
  }

  bool is_simple(std::size_t begin, std::size_t end) const {
    return end - begin == 2 && from(sorted_[begin].id) != from(sorted_[begin + 1].id);
  }

  void pair_around_edge(std::size_t begin, std::size_t end) {
    if ((end - begin) % 2)
      fail(Status::mesh_nonmanifold, "%zu boundary faces meet at the edge from vertex %lld to vertex %lld", end - begin,
           numbers_.vertex(low_end(sorted_[begin].id)), numbers_.vertex(sorted_[begin].high));
    out_.nonmanifold_edges++;
    for (const std::int32_t end_of_edge : {low_end(sorted_[begin].id), sorted_[begin].high})
      out_.touching[std::size_t(end_of_edge)] |= at_nonmanifold_edge;
    sort_by_angle(begin, end);
    // Material lies before a triangle whose half-edge runs up, and behind one whose half-edge runs down.
    const std::size_t first = runs_up(sorted_[begin].id) ? begin + 1 : begin;
    for (std::size_t i = 0; i < end - begin; i += 2) {
      const std::size_t down = begin + (first - begin + i) % (end - begin);
      const std::size_t up = begin + (first - begin + i + 1) % (end - begin);
      pair(sorted_[down].id, sorted_[up].id);
    }
  }

  void pair(std::int32_t a, std::int32_t b) {
    if (from(a) == from(b) || a == b)
      fail(Status::mesh_intersecting,
           "solids overlap, or touch without sharing faces, at the boundary edge from vertex %lld to vertex %lld",
           numbers_.vertex(low_end(a)), numbers_.vertex(std::max(from(a), to(a))));
    out_.mate[std::size_t(a)] = b;
    out_.mate[std::size_t(b)] = a;
  }

  /// Counter-clockwise around the edge, seen from its higher end. Exact: what belongs together is found again after
  /// decimation, also in a plate that is thinner than rounding. Where two lie on one another, the one wedge ends before
  /// the other begins: these are solids in contact.
  void sort_by_angle(std::size_t begin, std::size_t end) {
    const std::int32_t some = sorted_[begin].id;
    const Vec3 &low = points_[std::size_t(low_end(some))], &high = points_[std::size_t(sorted_[begin].high)];
    const Vec3 &first = points_[std::size_t(apex(some))];
    std::sort(sorted_.begin() + std::ptrdiff_t(begin), sorted_.begin() + std::ptrdiff_t(end),
              [&](const HalfEdge &a, const HalfEdge &b) {
                const Vec3 &p = points_[std::size_t(apex(a.id))], &q = points_[std::size_t(apex(b.id))];
                const int half = half_around(low, high, first, p), other = half_around(low, high, first, q);
                if (half != other) return half < other;
                const int order = half % 2 ? orientation(low, high, p, q) : 0;
                if (order != 0) return order > 0;
                const bool ends = runs_up(a.id), other_ends = runs_up(b.id);
                return ends != other_ends ? ends : a.id < b.id;
              });
  }

  /// Of p around the edge, from the plane of `first` on: 0 in that half-plane, 1 before the opposite one, 2 in it, 3
  /// beyond it.
  static int half_around(const Vec3 &low, const Vec3 &high, const Vec3 &first, const Vec3 &p) {
    const int side = orientation(low, high, first, p);
    if (side != 0) return side > 0 ? 1 : 3;
    for (int k = 0; k < 3; k++) {
      const int i = next(k), j = next(i), way = turn(low, high, first, i, j);
      if (way != 0) return turn(low, high, p, i, j) == -way ? 2 : 0;
    }
    return 0;
  }

  /// Corners around a vertex that mates join are one vertex of the cut surface.
  void find_sheet_vertices() {
    const std::size_t corners = 3 * triangles_.size();
    out_.sheet_vertex.assign(corners, -1);
    Array<std::uint8_t> sheets(points_.size(), 0, &job_.memory);
    for (std::size_t c = 0; c < corners; c++) {
      job_.poll_at(c, 0);
      if (out_.sheet_vertex[c] >= 0) continue;
      const auto sheet = std::int32_t(out_.vertex_of.size());
      const std::int32_t v = from(std::int32_t(c));
      out_.vertex_of.push_back(v);
      std::uint8_t &count = sheets[std::size_t(v)];
      out_.used_points += count == 0;
      out_.nonmanifold_points += count == 1;
      if (count == 1) out_.touching[std::size_t(v)] |= cut_apart;
      count = std::uint8_t(std::min(count + 1, 2));
      // The corner of the next triangle around the vertex begins where the mate of the edge that arrives here begins.
      for (auto at = std::int32_t(c); out_.sheet_vertex[std::size_t(at)] < 0;
           at = out_.mate[std::size_t(3 * (at / 3) + next(next(at % 3)))])
        out_.sheet_vertex[std::size_t(at)] = sheet;
    }
  }

  void find_components() {
    Array<std::int32_t> stack(&job_.memory);
    out_.component.assign(triangles_.size(), -1);
    for (std::size_t t = 0; t < triangles_.size(); t++) {
      if (out_.component[t] >= 0) continue;
      const auto number = std::int32_t(out_.components++);
      out_.component[t] = number;
      stack.push_back(std::int32_t(t));
      for (std::size_t seen = 0; !stack.empty(); seen++) {
        job_.poll_at(seen, 0);
        const std::int32_t at = stack.back();
        stack.pop_back();
        for (int k = 0; k < 3; k++) {
          const std::int32_t neighbour = out_.mate[std::size_t(3 * at + k)] / 3;
          if (out_.component[std::size_t(neighbour)] >= 0) continue;
          out_.component[std::size_t(neighbour)] = number;
          stack.push_back(neighbour);
        }
      }
    }
  }

  Span<const Vec3> points_;
  Span<const Triangle> triangles_;
  const HostNumbers &numbers_;
  Job &job_;
  SurfaceTopology &out_;
  Array<std::int32_t> begin_{&job_.memory};
  Array<HalfEdge> sorted_{&job_.memory};
};

}  // namespace

void find_topology(Span<const Vec3> points, Span<const Triangle> triangles, Job &job, SurfaceTopology &topology,
                   const HostNumbers &numbers) {
  TopologyFinder(points, triangles, numbers, job, topology).find();
}

}  // namespace tetlod
