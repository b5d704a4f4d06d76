#include "insert_vertices.hpp"

#include <algorithm>
#include <utility>

#include "few.hpp"

namespace tetlod {

namespace {

/// A vertex nearer than this to a face of the boundary, in weights, goes onto it; to another face, stays off by it.
constexpr double near_face = 0.12;
/// What the values that are there count as, in probes: a few that hardly weigh would take the new vertex anywhere.
constexpr double as_it_is = 0.1;

template <std::size_t m>
Vec3 centre_of_residuals(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  const TetFrame frame = mesh.frame(t);
  Vec3 sum(0);
  double total = 0;
  mesh.for_probes(t, [&](std::int32_t p) {
    const Probe<m> &probe = mesh.probes[std::size_t(p)];
    double w[4];
    frame.weights(probe.point, w);
    const double square = mesh.weight_of(p) * mesh.square(mesh.residual(mesh.tets[std::size_t(t)], w, probe));
    sum += square * probe.point;
    total += square;
  });
  return sum / total;
}

template <std::size_t m>
Values<m> linear_values(const AdaptiveMesh<m> &mesh, std::int32_t t, const Vec3 &p) {
  double w[4];
  mesh.frame(t).weights(p, w);
  Values<m> values{};
  for (int k = 0; k < 4; k++)
    for (std::size_t i = 0; i < m; i++) values[i] += w[k] * mesh.value(t, k)[i];
  return values;
}

/// What `values` at p become at another place in t, not beyond what there is.
template <std::size_t m>
Values<m> carried_along(const AdaptiveMesh<m> &mesh, std::int32_t t, const Vec3 &p, Values<m> values,
                        const Vec3 &place) {
  ValueRange<m> range(values);
  for (int k = 0; k < 4; k++) range.add(mesh.value(t, k));
  const Values<m> from = linear_values(mesh, t, p), to = linear_values(mesh, t, place);
  for (std::size_t i = 0; i < m; i++) values[i] += to[i] - from[i];
  return range.clamp(values);
}

/// The values at p in t by least squares over its probes, where the hat function of the vertex to be is least weight,
/// drawn a little towards what the mesh has there.
template <std::size_t m>
Values<m> values_at(const AdaptiveMesh<m> &mesh, std::int32_t t, const Vec3 &p) {
  const TetFrame frame = mesh.frame(t);
  Values<m> values = linear_values(mesh, t, p);
  double at_p[4], below = 0;
  frame.weights(p, at_p);
  Values<m> above{};
  ValueRange<m> range(mesh.value(t, 0));
  for (int k = 0; k < 4; k++) range.add(mesh.value(t, k));
  mesh.for_probes(t, [&](std::int32_t number) {
    const Probe<m> &probe = mesh.probes[std::size_t(number)];
    double w[4], hat = 1;
    frame.weights(probe.point, w);
    for (int k = 0; k < 4; k++)
      if (at_p[k] > 1e-9) hat = std::min(hat, w[k] / at_p[k]);
    hat = std::max(hat, 0.0);
    const double weight = mesh.weight_of(number) * hat;
    const Values<m> r = mesh.residual(mesh.tets[std::size_t(t)], w, probe);
    for (std::size_t i = 0; i < m; i++) above[i] -= weight * r[i];
    below += weight * hat;
    range.add(probe.value);
  });
  for (std::size_t i = 0; i < m; i++) values[i] += above[i] / (below + as_it_is);
  return range.clamp(values);
}

/// Puts the worst of the tets from `first` on in order, to `last`, the worst first; where that ends.
template <std::size_t m>
std::size_t sort_worst(const AdaptiveMesh<m> &mesh, std::size_t first, std::size_t last, Job &job,
                       Array<std::int32_t> &tets) {
  const PollingLess worse(job, 0.5, [&](std::int32_t a, std::int32_t b) {
    const double x = mesh.error[std::size_t(a)], y = mesh.error[std::size_t(b)];
    return x != y ? x > y : a < b;
  });
  const auto at = [&](std::size_t i) { return tets.begin() + std::ptrdiff_t(i); };
  last = std::min(last, tets.size());
  std::nth_element(at(first), at(last), tets.end(), worse);
  std::sort(at(first), at(last), worse);
  return last;
}

/// The tet, or the face or edge of it, that gets a vertex, and where.
struct Divided {
  Few<std::int32_t, 4> corners;
  Vec3 place{0};
};

/// Corners that p in t has a weight below `snap` of do not count.
Divided divided_at(const TetComplex &mesh, std::int32_t t, const Vec3 &p, double snap) {
  Divided divided;
  double w[4], total = 0;
  mesh.frame(t).weights(p, w);
  for (int k = 0; k < 4; k++) {
    if (w[k] < snap) continue;
    divided.corners.push(mesh.tets[std::size_t(t)][std::size_t(k)]);
    divided.place += w[k] * mesh.corner(t, k);
    total += w[k];
  }
  divided.place = divided.corners.size() == 4 ? p : divided.place / total;
  return divided;
}

/// What becomes of the tets that have all of some corners, of which t is one: a new vertex takes the place of each.
struct Division {
  Division(const TetComplex &mesh, std::int32_t t, const Few<std::int32_t, 4> &corners, Memory &memory)
      : old(&memory), fresh(&memory), faces(&memory) {
    const auto v = std::int32_t(mesh.points.size());
    mesh.tets_with(t, corners.begin(), corners.size(), old);
    for (std::int32_t whole : old)
      for (std::size_t k = 0; k < 4; k++) {
        Tet part = mesh.tets[std::size_t(whole)];
        if (corners.has(std::exchange(part[k], v)))
          fresh.push_back(part);
        else if (mesh.neighbours[std::size_t(whole)][k] < 0)
          faces.push_back(face_opposite(part, k));
      }
  }

  Array<std::int32_t> old;
  Array<Tet> fresh;
  Array<Triangle> faces;  ///< of the boundary, that are divided
};

/// Where the solid touches itself along an edge, not all of its tets are neighbours.
bool is_touching_edge(const TetComplex &mesh, Span<const std::int32_t> corners) {
  return corners.size() == 2 && mesh.fixed[std::size_t(corners[0])] == touching &&
         mesh.fixed[std::size_t(corners[1])] == touching;
}

/// Faces among vertices that the host keeps stay, so that partitions with kept interfaces go on fitting.
bool are_kept(const TetComplex &mesh, Span<const std::int32_t> corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::int32_t u) { return (mesh.kept[std::size_t(u)] & ~held) != 0; });
}

/// Whether it may be boundary: the place, and the middles of the new edges and triangles.
bool may_bound(const TetComplex &mesh, Span<const Triangle> faces, const Divided &divided) {
  const Vec3 &place = divided.place;
  if (!mesh.may_bound) return true;
  if (!mesh.may_bound(place)) return false;
  for (const Triangle &face : faces)
    for (std::size_t k = 0; k < 3; k++) {
      if (!divided.corners.has(face[k])) continue;
      const Vec3 &a = mesh.points[std::size_t(face[(k + 1) % 3])], &b = mesh.points[std::size_t(face[(k + 2) % 3])];
      for (const Vec3 &middle : {0.5 * (place + a), 0.5 * (place + b), (place + a + b) / 3.0})
        if (!mesh.may_bound(middle)) return false;
    }
  return true;
}

bool may_divide_boundary(const TetComplex &mesh, Span<const Triangle> faces, const Divided &divided) {
  return faces.empty() || (!are_kept(mesh, divided.corners) && may_bound(mesh, faces, divided));
}

}  // namespace

template <std::size_t m>
bool insert_vertex(std::int32_t t, const Vec3 &p, const Values<m> &values, double snap, double least,
                   AdaptiveMesh<m> &mesh) {
  const Divided divided = divided_at(mesh, t, p, snap);
  if (divided.corners.size() < 2 || is_touching_edge(mesh, divided.corners)) return false;
  const Division division(mesh, t, divided.corners, mesh.memory());
  if (!may_divide_boundary(mesh, division.faces, divided)) return false;
  mesh.points.push_back(divided.place);
  const auto is_sound = [&](const Tet &part) { return mesh.is_sound(part, least); };
  if (!std::all_of(division.fresh.begin(), division.fresh.end(), is_sound)) {
    mesh.points.pop_back();
    return false;
  }
  mesh.values.push_back(carried_along(mesh, t, p, values, divided.place));
  mesh.fixed.push_back(!division.faces.empty());
  mesh.kept.push_back(0);
  mesh.tet_of.push_back(-1);
  Array<std::int32_t> made(&mesh.memory());
  mesh.replace(division.old, division.fresh, made);
  return true;
}

template <std::size_t m>
void insert_vertices(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh) {
  Array<std::int32_t> worst(&job.memory);
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    if (mesh.alive(std::int32_t(t)) && mesh.error[t] > 0) worst.push_back(std::int32_t(t));
  const auto nearly = std::int64_t(mesh.count()) + tets - 1;  // each brings two or three
  for (std::size_t i = 0, sorted = 0; i < worst.size() && std::int64_t(mesh.count()) < nearly; i++) {
    if (i % 64 == 0) job.poll(0.5);
    if (i == sorted) sorted = sort_worst(mesh, sorted, sorted + std::size_t(tets), job, worst);
    const std::int32_t t = worst[i];
    if (!mesh.alive(t) || mesh.error[std::size_t(t)] <= 0) continue;
    Vec3 p = centre_of_residuals(mesh, t);
    double w[4];
    const double least = mesh.frame(t).weights(p, w);
    const auto side = std::size_t(std::min_element(w, w + 4) - w);
    const bool to_boundary = mesh.neighbours[std::size_t(t)][side] < 0 && least < near_face;
    if (!to_boundary && least < near_face) {  // towards the middle
      const Vec3 middle = 0.25 * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2) + mesh.corner(t, 3));
      p += (near_face - least) / (0.25 - least) * (middle - p);
    }
    insert_vertex(t, p, values_at(mesh, t, p), to_boundary ? near_face : 0, least_shape, mesh);
  }
}

template void insert_vertices(std::int64_t, Job &, AdaptiveMesh<1> &);
template void insert_vertices(std::int64_t, Job &, AdaptiveMesh<2> &);
template void insert_vertices(std::int64_t, Job &, AdaptiveMesh<3> &);
template void insert_vertices(std::int64_t, Job &, AdaptiveMesh<4> &);
template bool insert_vertex(std::int32_t, const Vec3 &, const Values<1> &, double, double, AdaptiveMesh<1> &);
template bool insert_vertex(std::int32_t, const Vec3 &, const Values<2> &, double, double, AdaptiveMesh<2> &);
template bool insert_vertex(std::int32_t, const Vec3 &, const Values<3> &, double, double, AdaptiveMesh<3> &);
template bool insert_vertex(std::int32_t, const Vec3 &, const Values<4> &, double, double, AdaptiveMesh<4> &);

}  // namespace tetlod
