#include "extract_boundary.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "disjoint_sets.hpp"
#include "face_sweep.hpp"
#include "predicates.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

/// Their sides are numbered with 32 bits.
constexpr std::size_t most_triangles = (std::size_t(1) << 31) / 3 - 1;

Triangle outward_face(const Tet &t, std::size_t k, int sign) {
  Triangle face = face_opposite(t, k);
  if (sign < 0) std::swap(face[1], face[2]);
  // From its lowest vertex on, so that the order of the tet's corners leaves no trace.
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

/// What one chunk of the sweep found.
struct Found {
  explicit Found(Memory &memory) : triangles(&memory), tet_of(&memory), flat(&memory), duplicate(&memory) {}
  Array<Triangle> triangles;
  Array<std::int32_t> tet_of;
  Array<std::int32_t> flat;       // boundary tets that cannot say which way is out
  Array<std::int32_t> duplicate;  // tets with the same four vertices as an earlier one
  std::string crowded;            // its first face of more than two tets; empty: there is none
};

void add_boundary_face(const MeshView &mesh, const FaceUse &f, Found &found) {
  const Tet &t = mesh.tets[f.tet()];
  const int sign = orientation(mesh.points, t);
  if (sign == 0) {
    found.flat.push_back(std::int32_t(f.tet()));
    return;
  }
  found.triangles.push_back(outward_face(t, f.corner(), sign));
  found.tet_of.push_back(std::int32_t(f.tet()));
}

/// Two tets on one face are neighbours unless they are one tet given twice; more than two are an error unless enough
/// of them are. Which chunk comes to its own first is chance.
void look_at_shared_face(const MeshView &mesh, std::int32_t low, Span<const FaceUse> uses, const HostNumbers &numbers,
                         Job &job, Found &found) {
  const Array<std::uint8_t> again = find_given_again(uses, mesh.tets, job);
  for (std::size_t i = 0; i < uses.size(); i++)
    if (again[i]) found.duplicate.push_back(std::int32_t(uses[i].tet()));
  Array<std::size_t> different(&job.memory);
  for (std::size_t i = 0; i < uses.size(); i++)
    if (!again[i]) different.push_back(uses[i].tet());
  if (different.size() > 2 && found.crowded.empty())
    found.crowded =
        text("%zu tets share the face of vertices %lld, %lld and %lld (the first are tets %lld, %lld, %lld)",
             different.size(), numbers.vertex(low), numbers.vertex(uses[0].middle), numbers.vertex(uses[0].high),
             numbers.tet(different[0]), numbers.tet(different[1]), numbers.tet(different[2]));
}

Found sweep(const MeshView &mesh, Span<const std::uint8_t> excluded, const HostNumbers &numbers, Job &job) {
  const FaceSweep faces(mesh, excluded, job);
  Array<Found> chunks(&job.memory);
  for (std::size_t c = 0; c < faces.chunks(); c++) chunks.emplace_back(job.memory);
  faces.visit([&](std::size_t chunk, std::int32_t low, const FaceUse *first, const FaceUse *last) {
    const Span<const FaceUse> uses(first, std::size_t(last - first));
    if (uses.size() == 1)
      add_boundary_face(mesh, *first, chunks[chunk]);
    else if (!are_neighbours(uses, mesh.tets))
      look_at_shared_face(mesh, low, uses, numbers, job, chunks[chunk]);
  });
  for (const Found &chunk : chunks)
    if (!chunk.crowded.empty()) throw Error(Status::mesh_nonmanifold, chunk.crowded);
  Found all = std::move(chunks[0]);
  for (std::size_t c = 1; c < chunks.size(); c++) {
    const auto append = [](auto &to, const auto &from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.triangles, chunks[c].triangles);
    append(all.tet_of, chunks[c].tet_of);
    append(all.flat, chunks[c].flat);
    append(all.duplicate, chunks[c].duplicate);
  }
  return all;
}

/// Those without a volume, as a mesh of their own.
struct TetsWithoutVolume {
  TetsWithoutVolume(const MeshView &mesh, Span<const std::uint8_t> excluded, Job &job)
      : tets(&job.memory), number(&job.memory) {
    Array<std::uint8_t> is_flat(mesh.tets.size(), 0, &job.memory);
    for_each(mesh.tets.size(), job, [&](std::size_t t) {
      is_flat[t] = (excluded.empty() || !excluded[t]) && orientation(mesh.points, mesh.tets[t]) == 0;
    });
    for (std::size_t t = 0; t < is_flat.size(); t++) {
      job.poll_at(t, 0.9);
      if (!is_flat[t]) continue;
      tets.push_back(mesh.tets[t]);
      number.push_back(std::int32_t(t));
    }
  }
  std::int32_t place_of(std::int32_t of_all) const {
    return std::int32_t(std::lower_bound(number.begin(), number.end(), of_all) - number.begin());
  }
  Array<Tet> tets;
  Array<std::int32_t> number;  // of each, ascending
};

/// Of the flat tets at the boundary, and those that are there when these have gone: not by a sweep for each layer.
void add_flat_behind(const MeshView &mesh, Span<const std::uint8_t> excluded, Job &job, Array<std::int32_t> &flat) {
  if (flat.empty()) return;
  const TetsWithoutVolume all(mesh, excluded, job);
  DisjointSets layers(all.tets.size(), job.memory);
  for_each_face(without_fields(mesh.points, all.tets), {}, job, [&](const FaceUse *first, const FaceUse *last) {
    for (const FaceUse *use = first + 1; use < last; use++)
      layers.join(std::int32_t(first->tet()), std::int32_t(use->tet()));
  });
  Array<std::uint8_t> goes(all.tets.size(), 0, &job.memory);
  for (const std::int32_t t : flat) goes[std::size_t(layers.lowest(all.place_of(t)))] = 1;
  for (std::size_t i = 0; i < goes.size(); i++) {
    job.poll_at(i, 0.9);
    if (goes[std::size_t(layers.lowest(std::int32_t(i)))]) flat.push_back(all.number[i]);
  }
}

/// How many of the tets were not excluded before.
std::int64_t exclude(Span<const std::int32_t> tets, std::size_t count, Array<std::uint8_t> &excluded) {
  std::int64_t fresh = 0;
  if (!tets.empty()) excluded.resize(count, 0);
  for (std::int32_t t : tets) {
    fresh += excluded[std::size_t(t)] == 0;
    excluded[std::size_t(t)] = 1;
  }
  return fresh;
}

void find_interior(const MeshView &mesh, Span<const std::uint8_t> excluded, Job &job, Boundary &boundary) {
  enum : std::uint8_t { unused, used, on_boundary };
  Array<std::uint8_t> place(mesh.points.size(), unused, &job.memory);
  for_each(mesh.tets.size(), job, [&](std::size_t t) {
    if (excluded.empty() || !excluded[t])
      for (std::int32_t v : mesh.tets[t]) set_flag(place[std::size_t(v)]);
  });
  for (const Triangle &t : boundary.triangles)
    for (std::int32_t v : t) place[std::size_t(v)] = on_boundary;
  for (std::size_t v = 0; v < place.size(); v++) {
    if (place[v] == used) boundary.interior.push_back(std::int32_t(v));
    boundary.unused_points += place[v] == unused;
  }
}

}  // namespace

void extract_boundary(const MeshView &mesh, Job &job, Boundary &boundary, const HostNumbers &numbers) {
  Array<std::uint8_t> &excluded = boundary.excluded;
  excluded.clear();
  for (;;) {
    Found found = sweep(mesh, excluded, numbers, job);
    const std::int64_t duplicate = exclude(found.duplicate, mesh.tets.size(), excluded);
    add_flat_behind(mesh, excluded, job, found.flat);
    const std::int64_t flat = exclude(found.flat, mesh.tets.size(), excluded);
    boundary.duplicate_tets += duplicate;
    boundary.flat_tets += flat;
    if (duplicate + flat) continue;
    boundary.triangles = std::move(found.triangles);
    boundary.tet_of = std::move(found.tet_of);
    break;
  }
  const std::size_t triangles = boundary.triangles.size();
  if (triangles == 0) fail(Status::mesh_degenerate, "none of the %zu tets has a volume", mesh.tets.size());
  if (triangles > most_triangles)
    fail(Status::mesh_too_large, "%zu boundary triangles, the most is %zu", triangles, most_triangles);
  find_interior(mesh, excluded, job, boundary);
}

void make_surface(const MeshView &mesh, Span<const Triangle> triangles, Job &job, Surface &surface) {
  Array<std::int32_t> number(mesh.points.size(), -1, &job.memory);
  surface.fields = mesh.fields;
  surface.triangles.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); i++) {
    job.poll_at(i, 0);
    const Triangle &t = triangles[i];
    Triangle renumbered;
    for (std::size_t k = 0; k < 3; k++) {
      std::int32_t &n = number[std::size_t(t[k])];
      if (n < 0) {
        n = std::int32_t(surface.points.size());
        surface.points.push_back(mesh.points[std::size_t(t[k])]);
        for (std::size_t f = 0; f < mesh.fields; f++)
          surface.scalars.push_back(mesh.scalars[std::size_t(t[k]) * mesh.fields + f]);
        surface.origin.push_back(t[k]);
      }
      renumbered[k] = n;
    }
    surface.triangles.push_back(renumbered);
  }
}

}  // namespace tetlod
