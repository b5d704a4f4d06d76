#include "contacts.hpp"

#include <algorithm>
#include <limits>

#include "came_from.hpp"
#include "first_culprit.hpp"
#include "geometry.hpp"
#include "predicates.hpp"
#include "surface_distance.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Of the diagonal: how far solids that touch may reach into each other, as coordinates have few digits in some files,
/// and how far behind a triangle one looks at least.
constexpr double most_reach = 1e-3, least_reach = 1e-6;
constexpr std::size_t block = 256;

struct Extent {
  double low, high;
};

Extent extent_along(const Vec3 &axis, const Vec3 &from, const Vec3 p[3]) {
  const double a = glm::dot(axis, p[0] - from), b = glm::dot(axis, p[1] - from), c = glm::dot(axis, p[2] - from);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

template <class T>
void sort_unique(Array<T> &array) {
  std::sort(array.begin(), array.end());
  array.erase(std::unique(array.begin(), array.end()), array.end());
}

/// Pairs that come again and again: of parts that meet at an edge all triangles there meet all others.
class Pairs {
 public:
  explicit Pairs(Memory &memory) : pairs_(&memory) {}
  void add(std::uint64_t pair) {
    pairs_.push_back(pair);
    if (pairs_.size() < 2 * different_ + 1024) return;
    sort_unique(pairs_);
    different_ = pairs_.size();
  }
  Span<const std::uint64_t> all() const { return pairs_; }

 private:
  Array<std::uint64_t> pairs_;
  std::size_t different_ = 0;  // of the first ones
};

/// What is known of triangles that meet.
struct Meetings {
  Meetings(std::size_t triangles, std::size_t components, Memory &memory)
      : meets(triangles, 0, &memory), goes_deep(components, 0, &memory), pairs(&memory), places(&memory) {}
  Array<std::uint8_t> meets;      // of each triangle
  Array<std::uint8_t> goes_deep;  // of each component, whether one of its triangles does, beside what touches
  Array<std::uint64_t> pairs;     // of components
  Array<Box> places;              // where one meets itself
};

/// How far two triangles reach into each other along an axis; without end where it has no length.
double reach_along(const Vec3 &axis, const Vec3 a[3], const Vec3 b[3]) {
  const double length = glm::length(axis);
  if (!(length > 0)) return std::numeric_limits<double>::infinity();
  const Extent of_a = extent_along(axis / length, a[0], a), of_b = extent_along(axis / length, a[0], b);
  return std::min(of_a.high - of_b.low, of_b.high - of_a.low);
}

/// Along the axis along which it is the least.
double reach_of(const Vec3 a[3], const Vec3 b[3]) {
  double least = reach_along(area_vector(a[0], a[1], a[2]), a, b);
  least = std::min(least, reach_along(area_vector(b[0], b[1], b[2]), a, b));
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      least = std::min(least, reach_along(glm::cross(a[(i + 1) % 3] - a[i], b[(j + 1) % 3] - b[j]), a, b));
  return least;
}

class ContactFinder {
 public:
  ContactFinder(const Surface &surface, const SurfaceTopology &topology, const TriangleTree &tree, bool with_itself,
                Job &job)
      : surface_(surface),
        topology_(topology),
        tree_(tree),
        with_itself_(with_itself),
        job_(job),
        diagonal_(box_of(surface.points).diagonal()) {}

  Contacts find() const {
    Meetings all(surface_.triangles.size(), std::size_t(topology_.components), job_.memory);
    if (!find_meetings(all) || all.pairs.empty() || any_covered(all)) return Contacts(job_.memory);
    KdTree itself(job_.memory);
    itself.build(std::move(all.places), 8, job_);
    return {std::move(all.pairs), std::move(itself)};
  }

 private:
  std::int32_t component(std::int32_t t) const { return topology_.component[std::size_t(t)]; }
  /// And around it, as far as what touches may reach.
  Box place_of(std::int32_t a, std::int32_t b) const {
    const auto box = [&](std::int32_t t) { return box_of(surface_.points, surface_.triangles[std::size_t(t)]); };
    const Box place = common(box(a), box(b));
    return {place.low - most_reach * diagonal_, place.high + most_reach * diagonal_};
  }
  TriangleInSpace triangle(std::int32_t t) const { return {surface_.points, surface_.triangles[std::size_t(t)]}; }

  /// What one block of triangles adds to Meetings.
  struct OfBlock {
    explicit OfBlock(Memory &memory) : pairs(memory), places(&memory) {}
    Pairs pairs;
    Array<Box> places;
  };

  /// False where they overlap.
  bool look_at(std::int32_t a, std::int32_t b, OfBlock &of_block, Meetings &all) const {
    const TriangleInSpace p = triangle(a), q = triangle(b);
    const Vec3 first[3] = {p.a, p.b, p.c}, second[3] = {q.a, q.b, q.c};
    if (triangles_apart(first, surface_.triangles[std::size_t(a)], second, surface_.triangles[std::size_t(b)]))
      return true;
    const double reach = reach_of(first, second);
    if (!(reach <= most_reach * diagonal_)) return false;
    for (const std::int32_t t : {a, b}) {
      set_flag(all.meets[std::size_t(t)]);
      if (reach > least_reach * diagonal_) set_flag(all.goes_deep[std::size_t(component(t))]);
    }
    of_block.pairs.add(Contacts::pair_of(component(a), component(b)));
    if (component(a) == component(b)) of_block.places.push_back(place_of(a, b));
    return true;
  }

  bool is_asked_for(std::int32_t a, std::int32_t b) const {
    return b > a && (with_itself_ || component(a) != component(b));
  }

  /// False where two overlap.
  bool find_meetings(Meetings &all) const {
    const std::size_t count = surface_.triangles.size();
    Array<OfBlock> of_blocks(&job_.memory);
    for (std::size_t i = 0; i < count / block + 1; i++) of_blocks.emplace_back(job_.memory);
    FirstCulprit overlap;
    job_.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end && !overlap.any(); t++) {
        if (t % 8 == 0) job_.poll(double(t) / double(count));
        const auto a = std::int32_t(t);
        tree_.for_near(a, [&](std::int32_t b) {
          if (is_asked_for(a, b) && !look_at(a, b, of_blocks[begin / block], all)) overlap.report(t);
        });
      }
    });
    if (overlap.any()) return false;
    for (const OfBlock &some : of_blocks) {
      all.pairs.insert(all.pairs.end(), some.pairs.all().begin(), some.pairs.all().end());
      all.places.insert(all.places.end(), some.places.begin(), some.places.end());
    }
    return true;
  }

  /// Whether a triangle that meets another lies in another solid's material. Solids that do not just touch may be
  /// deeper in each other than their triangles reach.
  bool any_covered(const Meetings &all) const {
    FirstCulprit covered;
    for_each(all.meets.size(), job_, [&](std::size_t t) {
      if (t % 64 == 0) job_.poll(0);  // a ray may meet very many
      if (!all.meets[t] || covered.any()) return;
      const auto triangle = std::int32_t(t);
      const bool is_deep = all.goes_deep[std::size_t(component(triangle))] != 0;
      if (!has_material_once(triangle, (is_deep ? most_reach : least_reach) * diagonal_)) covered.report(t);
    });
    return covered.any();
  }

  /// Just behind it, farther than solids that touch reach into each other, or, where it is not so thick, within it.
  bool has_material_once(std::int32_t t, double reach) const {
    const TriangleInSpace at = triangle(t);
    const Vec3 normal = area_vector(at.a, at.b, at.c);
    const double length = glm::length(normal);
    if (!(length > 0)) return false;
    std::optional<int> depth = 0;
    for (double far = reach; depth == 0 && far >= least_reach * diagonal_; far /= 2)
      depth = tree_.depth(at.middle() - 2 * far / length * normal);
    return depth == 1;
  }

  const Surface &surface_;
  const SurfaceTopology &topology_;
  const TriangleTree &tree_;
  bool with_itself_;
  Job &job_;
  double diagonal_;
};

}  // namespace

Contacts::Contacts(Array<std::uint64_t> pairs, KdTree &&itself)
    : pairs_(std::move(pairs)), members_(pairs_.get_allocator()), itself_(std::move(itself)) {
  for (const std::uint64_t pair : pairs_)
    members_.insert(members_.end(), {std::int32_t(pair >> 32), std::int32_t(std::uint32_t(pair))});
  sort_unique(pairs_);
  sort_unique(members_);
}

std::uint64_t Contacts::pair_of(std::int32_t a, std::int32_t b) {
  return std::uint64_t(std::uint32_t(std::min(a, b))) << 32 | std::uint32_t(std::max(a, b));
}

bool Contacts::between(std::int32_t a, std::int32_t b) const {
  return std::binary_search(pairs_.begin(), pairs_.end(), pair_of(a, b));
}

bool Contacts::any(std::int32_t component) const {
  return std::binary_search(members_.begin(), members_.end(), component);
}

Contacts find_contacts(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree, bool with_itself,
                       Job &job) {
  if (!with_itself && topology.components < 2) return Contacts(job.memory);
  return ContactFinder(surface, topology, tree.get(job), with_itself, job).find();
}

Array<std::int32_t> components_of_vertices(const Surface &surface, const SurfaceTopology &topology,
                                           std::size_t vertices, Memory &memory) {
  constexpr std::int32_t none = -1, several = -2;
  Array<std::int32_t> component(vertices, none, &memory);
  for (std::size_t t = 0; t < surface.triangles.size(); t++)
    for (const std::int32_t corner : surface.triangles[t]) {
      std::int32_t &of_vertex = component[std::size_t(surface.origin[std::size_t(corner)])];
      if (of_vertex == none || of_vertex == topology.component[t])
        of_vertex = topology.component[t];
      else
        of_vertex = several;
    }
  std::replace(component.begin(), component.end(), several, none);
  return component;
}

Array<std::int32_t> components_of_triangles(Span<const Triangle> triangles, Span<const std::int32_t> origin,
                                            Span<const std::int32_t> of_vertices, Memory &memory) {
  Array<std::int32_t> component(triangles.size(), -1, &memory);
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (const std::int32_t corner : triangles[t])
      if (corner >= 0)
        component[t] = std::max(component[t], of_vertices[std::size_t(came_from(origin[std::size_t(corner)]))]);
  return component;
}

Array<std::int32_t> original_components(Span<const Triangle> triangles, const SurfaceTopology &topology,
                                        Span<const std::int32_t> vertex, const Surface &original,
                                        const SurfaceTopology &topology_of_original, Memory &memory) {
  const auto key = [](std::int32_t high, std::int32_t low) {
    return std::uint64_t(std::uint32_t(high)) << 32 | std::uint32_t(low);
  };
  Array<std::uint64_t> at_vertex(&memory), votes(&memory);  // a vertex, or a component, and an original component
  for (std::size_t t = 0; t < original.triangles.size(); t++)
    for (const std::int32_t corner : original.triangles[t])
      at_vertex.push_back(key(original.origin[std::size_t(corner)], topology_of_original.component[t]));
  sort_unique(at_vertex);
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (const std::int32_t corner : triangles[t]) {
      const std::int32_t v = vertex[std::size_t(corner)];
      auto at = std::lower_bound(at_vertex.begin(), at_vertex.end(), key(v, 0));
      for (; at != at_vertex.end() && std::int32_t(*at >> 32) == v; ++at)
        votes.push_back(key(topology.component[t], std::int32_t(std::uint32_t(*at))));
    }
  std::sort(votes.begin(), votes.end());
  Array<std::int32_t> winner(std::size_t(topology.components), -1, &memory);
  Array<std::size_t> most(winner.size(), 0, &memory);
  for (std::size_t first = 0, last = 0; first < votes.size(); first = last) {
    while (last < votes.size() && votes[last] == votes[first]) last++;
    const auto component = std::size_t(votes[first] >> 32);
    if (last - first <= most[component]) continue;
    most[component] = last - first;
    winner[component] = std::int32_t(std::uint32_t(votes[first]));
  }
  Array<std::int32_t> of_triangle(&memory);
  of_triangle.reserve(triangles.size());
  for (const std::int32_t component : topology.component) of_triangle.push_back(winner[std::size_t(component)]);
  return of_triangle;
}

}  // namespace tetlod
