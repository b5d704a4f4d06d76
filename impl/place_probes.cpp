#include "place_probes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "boundary_tree.hpp"
#include "random_place.hpp"
#include "solids.hpp"
#include "sort_by_place.hpp"
#include "tet_locator.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Probes inside a tet of the original: so many for every tet, and so many times its share of the field's changes; more
/// of both for a small mesh, whose vertices alone would say too little of what is between them.
constexpr double everywhere = 0.14, by_change = 0.42, small_mesh = 1e5, most_for_small = 1.6;
/// Probes for each tet of a result that say enough of it, of those so many where there are no rounds, and inside tets
/// where values are fitted alone.
constexpr double vertices_a_tet = 8, inner_a_tet = 8, vertices_without_rounds = 4, inner_without_rounds = 2,
                 inner_for_values = 1;
/// What a probe at a vertex counts as, of one inside: the original has its values there, and interpolates between. More
/// where rounds serve both.
constexpr double weight_of_vertex = 2, more_with_a_round = 0.5;
constexpr std::size_t block = 1024;

/// Of the values at the corners of t.
template <std::size_t m>
ValueRange<m> range_of(Span<const Values<m>> values, const Tet &t) {
  ValueRange<m> range(values[std::size_t(t[0])]);
  for (std::int32_t v : t) range.add(values[std::size_t(v)]);
  return range;
}

/// Of all fields together, as they count.
template <std::size_t m>
double change_of(const MeshView &mesh, const Tet &t) {
  const ValueRange<m> range = range_of(mesh.values<m>(), t);
  double change = range.high[0] - range.low[0];
  for (std::size_t k = 1; k < m; k++) change += mesh.scales.weighted[k] * (range.high[k] - range.low[k]);
  return change;
}

/// Of those that add up to `due`, each by its share: one whenever they are one more.
std::size_t taken(double due) { return std::size_t(0.5 + due); }

template <std::size_t m>
void add_vertices(const MeshView &original, double most, Job &job, AdaptiveMesh<m> &mesh) {
  Array<std::uint8_t> room(&job.memory);
  const Span<const std::uint8_t> used = used_points(original, job, room);
  const auto count = double(std::count(used.begin(), used.end(), 1));
  const double share = mesh.share_of_vertices = std::min(1.0, most / count);
  const Span<const Values<m>> values = original.values<m>();
  mesh.vertex_of_probe.reserve(std::size_t(std::min(most, count)));
  double due = 0;
  for (std::size_t v = 0; v < used.size(); v++) {
    if (!used[v]) continue;
    due += share;
    if (taken(due) <= mesh.probes.size()) continue;
    mesh.probes.push_back({original.place(v), values[v]});
    mesh.vertex_of_probe.push_back(std::int32_t(v));
  }
}

/// At a random place of tet t.
template <std::size_t m>
Probe<m> probe_inside(const MeshView &original, const Tet &t, std::uint64_t key) {
  double weights[4];
  random_weights(key, weights);
  const Span<const Values<m>> values = original.values<m>();
  Probe<m> probe{Vec3(0), {}};
  for (std::size_t k = 0; k < 4; k++) {
    probe.point += weights[k] * original.points[std::size_t(t[k])];
    for (std::size_t i = 0; i < m; i++) probe.value[i] += weights[k] * values[std::size_t(t[k])][i];
  }
  probe.value = range_of(values, t).clamp(probe.value);
  return probe;
}

/// What the shares of the tets are multiplied with, so that there are not many more than `most`.
double inner_scale(double tets, double most) {
  const double more = std::clamp(std::sqrt(small_mesh / tets), 1.0, most_for_small);
  return std::min(more, most / (tets * (everywhere + by_change)));
}

/// How many probes are due inside the first tets of a mesh.
class InnerShares {
 public:
  InnerShares(Span<const double> change_of_parts, std::size_t tets, double most) {
    const double change = std::accumulate(change_of_parts.begin(), change_of_parts.end(), 0.0);
    const double scale = inner_scale(double(tets), most);
    per_tet_ = scale * everywhere;
    by_changes_ = scale * by_change * double(tets);
    if (std::isfinite(change)) all_changes_ = change;
  }
  double due(std::size_t tets, double change) const {
    return per_tet_ * double(tets) + (all_changes_ > 0 ? by_changes_ * (change / all_changes_) : 0);
  }

 private:
  double per_tet_, by_changes_, all_changes_ = 0;  // 0, too, where the sum, of the largest doubles, is no number
};

/// solid: of each, where solids are in contact.
template <std::size_t m>
void add_inner(const MeshView &original, double most, Job &job, Array<Probe<m>> &probes, Array<std::int32_t> &solid) {
  const std::size_t tets = original.tets.size();
  const Array<double> changes =
      parts_of(tets, 0.0, job, [&](double &sum, std::size_t t) { sum += change_of<m>(original, original.tets[t]); });
  const InnerShares shares(changes, tets, most);
  Array<double> due_before(1, 0.0, &job.memory);
  for (std::size_t i = 0; i < changes.size(); i++)
    due_before.push_back(due_before.back() + shares.due(std::min(stretch, tets - i * stretch), changes[i]));
  const std::size_t before = probes.size();
  grow(probes, before + taken(due_before.back()), job);
  if (!original.solid.empty()) grow(solid, probes.size(), job, -1);
  job.parallel.for_blocks(tets, stretch, [&](std::size_t begin, std::size_t end) {
    const double due = due_before[begin / stretch];
    std::size_t next = taken(due);
    double change = 0;  // comes to the same as before, so that no part takes another's place
    for (std::size_t t = begin; t < end; t++) {
      change += change_of<m>(original, original.tets[t]);
      const std::size_t last = taken(due + shares.due(t + 1 - begin, change));
      for (; next < last; next++) {
        probes[before + next] = probe_inside<m>(original, original.tets[t], before + next);
        if (!solid.empty()) solid[before + next] = solid_of(original.solid, original.tets[t]);
      }
    }
    job.poll(0);
  });
}

/// solid: as above.
template <std::size_t m>
void add_probes(const MeshView &original, const ProbeOptions &options, Job &job, AdaptiveMesh<m> &mesh,
                Array<std::int32_t> &solid) {
  mesh.probes.reserve(expected_probes(original, options));
  add_vertices(original, options.most_vertices, job, mesh);
  mesh.vertex_probes = mesh.probes.size();
  mesh.vertex_weight = options.vertex_weight;
  if (!original.solid.empty())
    for (const std::int32_t v : mesh.vertex_of_probe) solid.push_back(original.solid[std::size_t(v)]);
  if (options.most_inner > 0) add_inner(original, options.most_inner, job, mesh.probes, solid);
}

/// The nearest point of the boundary, as nearest() finds it, of a point that was found in no tet (t is -1), or a little
/// outside of tet t, and of all, as that point is no farther off. Where it is farther, rounding has left a gap between
/// tets: none then.
template <class Nearest>
NearestPoint nearest_if_outside(const TetComplex &mesh, std::int32_t t, const Vec3 &p, const Nearest &nearest_to) {
  constexpr double slack = 2;
  if (t < 0) return nearest_to(p);
  double w[4];
  mesh.frame(t).weights(p, w);
  const double out = -*std::min_element(w, w + 4);  // of a flat tet, too
  if (out <= 0) return {};
  const double length2 = longest2(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), mesh.corner(t, 3));
  const NearestPoint nearest = nearest_to(p);
  return nearest.distance <= slack * out * std::sqrt(length2) ? nearest : NearestPoint();
}

/// Moves the vertices that are outside to the nearest point of the boundary, into the tet there.
template <std::size_t m>
void project(const SolidsOfTets &solids, Job &job, Array<std::int32_t> &home, AdaptiveMesh<m> &mesh) {
  const BoundaryTree boundary(mesh, job);
  mesh.outside.assign(mesh.vertex_probes, 0);
  job.parallel.for_blocks(mesh.vertex_probes, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const auto nearest_to = [&](const Vec3 &p) { return boundary.nearest(p, mesh.vertex_of_probe[i], solids); };
      const NearestPoint at = nearest_if_outside(mesh, home[i], mesh.probes[i].point, nearest_to);
      if (at.triangle < 0) continue;
      home[i] = boundary.tet_of_face[std::size_t(at.triangle)];
      mesh.outside[i] = 1;
      mesh.probes[i].point = TriangleInSpace(mesh.points, boundary.faces[std::size_t(at.triangle)]).at(at.weights);
    }
    job.poll(0.2);
  });
}

/// They become of the probes' own solids.
template <std::size_t m>
void keep_to_solids(const TetLocator &locator, const SolidsOfTets &solids, Span<const std::int32_t> solid, Job &job,
                    Array<std::int32_t> &home, AdaptiveMesh<m> &mesh) {
  for (std::size_t i = 0; i < home.size(); i++) {
    job.poll_at(i, 0.2);
    const auto may_hold = [&](std::int32_t t) { return may_be_one(solids.of(t), solid[i]); };
    if (home[i] < 0 || may_hold(home[i])) continue;
    home[i] = locator.find_among(mesh.probes[i].point, may_hold);
    if (home[i] < 0 && i < mesh.vertex_probes) mesh.in_no_tet.push_back(mesh.vertex_of_probe[i]);
  }
}

template <std::size_t m>
Array<std::int32_t> find_homes(const TetLocator &locator, const SolidsOfTets &solids, Span<const std::int32_t> solid,
                               Job &job, AdaptiveMesh<m> &mesh) {
  Array<std::int32_t> order(&job.memory), home(mesh.probes.size(), -1, &job.memory);
  order.reserve(mesh.probes.size());
  const auto append = [&](std::size_t first, std::size_t end) {  // so that walks are short
    const auto place = [&](std::size_t i) { return mesh.probes[first + i].point; };
    for (std::int32_t i : order_in_space(end - first, place, job)) order.push_back(std::int32_t(first) + i);
  };
  append(0, mesh.vertex_probes);
  append(mesh.vertex_probes, mesh.probes.size());
  Array<Array<std::int32_t>> outside_of_block(home.size() / block + 1, &job.memory);
  job.parallel.for_blocks(home.size(), block, [&](std::size_t begin, std::size_t end) {
    std::int32_t hint = -1;
    for (std::size_t k = begin; k < end; k++) {
      const auto i = std::size_t(order[k]);
      home[i] = locator.find(mesh.probes[i].point, hint);
      if (home[i] >= 0) hint = home[i];
      if (home[i] < 0 && i < mesh.vertex_probes) outside_of_block[begin / block].push_back(mesh.vertex_of_probe[i]);
    }
    job.poll(0.1 + 0.1 * double(end) / double(home.size()));
  });
  mesh.in_no_tet.clear();
  for (const Array<std::int32_t> &some : outside_of_block)
    mesh.in_no_tet.insert(mesh.in_no_tet.end(), some.begin(), some.end());
  if (solids.are_several()) keep_to_solids(locator, solids, solid, job, home, mesh);
  return home;
}

template <class T>
void put_in_places(Span<const std::int32_t> places, std::size_t begin, Job &job, Array<T> &of_probes) {
  const auto first = of_probes.begin() + std::ptrdiff_t(begin);
  const Array<T> before(first, first + std::ptrdiff_t(places.size()), &job.memory);
  job.poll(0.2);
  for_each(places.size(), job, [&](std::size_t i) { first[places[i]] = before[i]; });
}

/// Sorts probes begin to end by their tets, so that those of a tet lie side by side. Returns where each has come to be,
/// from begin on.
template <std::size_t m>
Array<std::int32_t> sort_by_home(std::size_t begin, std::size_t end, Job &job, AdaptiveMesh<m> &mesh,
                                 Array<std::int32_t> &home) {
  Array<std::int32_t> next(mesh.tets.size() + 2, 0, &job.memory), places(&job.memory);
  places.reserve(end - begin);
  for (std::size_t i = begin; i < end; i++) next[std::size_t(home[i] + 2)]++;
  job.poll(0.2);
  for (std::size_t t = 0; t + 1 < next.size(); t++) next[t + 1] += next[t];
  for (std::size_t i = begin; i < end; i++) places.push_back(next[std::size_t(home[i] + 1)]++);
  job.poll(0.2);
  put_in_places(places, begin, job, mesh.probes);
  put_in_places(places, begin, job, home);
  return places;
}

}  // namespace

ProbeOptions enough_probes(double tets, int rounds, bool follows_field) {
  ProbeOptions options;
  options.most_vertices = (rounds > 0 ? vertices_a_tet : vertices_without_rounds) * tets;
  options.most_inner = (rounds > 0 ? inner_a_tet : follows_field ? inner_without_rounds : inner_for_values) * tets;
  options.vertex_weight = weight_of_vertex + more_with_a_round * rounds;
  return options;
}

std::size_t expected_probes(const MeshView &original, const ProbeOptions &options) {
  const auto tets = double(original.tets.size());
  const double inner = inner_scale(tets, options.most_inner) * (everywhere + by_change) * tets;
  return std::size_t(std::min(double(original.points.size()), options.most_vertices) + 1.01 * inner);
}

template <std::size_t m>
void place_probes(const MeshView &original, const ProbeOptions &options, Job &job, AdaptiveMesh<m> &mesh) {
  mesh.probes.clear();
  mesh.vertex_of_probe.clear();
  mesh.outside.clear();
  Array<std::int32_t> solid(&job.memory);  // of each probe, where solids are in contact
  std::optional<TetLocator> locator;
  job.parallel.at_once([&] { add_probes(original, options, job, mesh, solid); }, [&] { locator.emplace(mesh, job); });
  const SolidsOfTets solids(mesh, original.solid, job);
  Array<std::int32_t> home = find_homes(*locator, solids, solid, job, mesh);
  locator.reset();
  if (options.project_outside) project(solids, job, home, mesh);
  const auto count_homeless = [&](std::size_t end) {
    return std::size_t(std::count(home.begin(), home.begin() + std::ptrdiff_t(end), -1));
  };
  mesh.left_out = count_homeless(home.size());
  mesh.vertices_left_out = count_homeless(mesh.vertex_probes);
  const Array<std::int32_t> places = sort_by_home(0, mesh.vertex_probes, job, mesh, home);
  put_in_places(places, 0, job, mesh.vertex_of_probe);
  if (options.project_outside) put_in_places(places, 0, job, mesh.outside);
  sort_by_home(mesh.vertex_probes, home.size(), job, mesh, home);
  mesh.next_probe.assign(home.size(), -1);
  job.poll(0.2);
  mesh.first_probe.assign(mesh.tets.size(), -1);
  for (std::size_t i = home.size(); i-- > 0;) {
    job.poll_at(i, 0.2);
    if (home[i] >= 0) mesh.put_probe(std::int32_t(i), home[i]);
  }
  mesh.measure_all(0.2, job);
}

template void place_probes(const MeshView &, const ProbeOptions &, Job &, AdaptiveMesh<1> &);
template void place_probes(const MeshView &, const ProbeOptions &, Job &, AdaptiveMesh<2> &);
template void place_probes(const MeshView &, const ProbeOptions &, Job &, AdaptiveMesh<3> &);
template void place_probes(const MeshView &, const ProbeOptions &, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
