#include "carry_fields.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "in_its_run.hpp"
#include "locate.hpp"
#include "transfer.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

bool any_of_association(const Input &input, Association association) {
  return std::any_of(input.fields.begin(), input.fields.end(),
                     [&](const SubmittedField &field) { return field.association == association; });
}

Array<Vec3> find_centroids(Span<const Vec3> points, Span<const Tet> tets, Job &job) {
  Array<Vec3> centroids = array_of(tets.size(), Vec3(0), job);
  for_each(tets.size(), job, [&](std::size_t t) {
    for (std::int32_t v : tets[t]) centroids[t] += points[std::size_t(v)];
    centroids[t] *= 0.25;
  });
  return centroids;
}

Array<std::int32_t> solids_of_tets(const TetMesh &mesh, Job &job) {
  Array<std::int32_t> solid(&job.memory);
  if (!mesh.solid.empty())
    for (const Tet &t : mesh.tets) solid.push_back(solid_of(mesh.solid, t));
  return solid;
}

/// The submitted tets that tets of the result take their values from.
class Sources {
 public:
  /// original: as its view, with solids.
  Sources(const Options &options, const Original &of, const MeshView &original, const Boundary &boundary, Job &job)
      : options_(options), of_(of), original_(original), boundary_(boundary), job_(job) {}

  /// solid: of each point, or empty.
  Array<std::int32_t> find(Span<const Vec3> points, Span<const std::int32_t> solid) const {
    Array<Place> places(&job_.memory);
    locate(original_, boundary_.triangles, points, solid, options_.tet_leaf, job_, places);
    Array<std::int32_t> sources = array_of(places.size(), -1, job_);
    for_each(places.size(), job_, [&](std::size_t i) {
      const std::int32_t tet = places[i].tet >= 0 ? places[i].tet : boundary_.tet_of[std::size_t(places[i].triangle)];
      sources[i] = of_.tet_number.empty() ? tet : of_.tet_number[std::size_t(tet)];
    });
    if (!of_.replaced.empty()) look_among_replaced(points, solid, places, sources);
    return sources;
  }

 private:
  Vec3 point_on_boundary(const Place &place) const {
    Vec3 point(0);
    for (std::size_t k = 0; k < 3; k++)
      point += place.weights[k] * original_.points[std::size_t(boundary_.triangles[std::size_t(place.triangle)][k])];
    return point;
  }

  /// What takes the place of several tets has the number of one of them, or of one beside them.
  void look_among_replaced(Span<const Vec3> points, Span<const std::int32_t> solid, Span<const Place> places,
                           Array<std::int32_t> &sources) const {
    Array<Vec3> inside(points.begin(), points.end(), &job_.memory);
    for (std::size_t i = 0; i < inside.size(); i++)
      if (places[i].tet < 0) inside[i] = point_on_boundary(places[i]);
    MeshView replaced = original_;
    replaced.tets = of_.replaced;
    const Array<std::int32_t> tets = find_tets(replaced, inside, solid, options_.tet_leaf, job_);
    for (std::size_t i = 0; i < tets.size(); i++)
      if (tets[i] >= 0) sources[i] = of_.replaced_number[std::size_t(tets[i])];
  }

  const Options &options_;
  const Original &of_;
  const MeshView &original_;
  const Boundary &boundary_;
  Job &job_;
};

template <class Way, class T>
void carry_into(Array<T> &values, const Way &way, std::size_t tuples, const StridedArray &from, Job &job) {
  values.resize(tuples * std::size_t(from.components));
  transfer(way, from, packed_array(values.data(), tuples, from.components), job);
}

template <class Way>
void carry_along(const Way &way, std::size_t tuples, const SubmittedField &field, Job &job, Result &result) {
  const StridedArray &from = field.values;
  CarriedField &carried =
      result.fields.emplace_back(field.name, field.association, from.type, from.components, job.memory);
  if (is_integer(from.type))
    carry_into(carried.integers, way, tuples, from, job);
  else
    carry_into(carried.values, way, tuples, from, job);
}

}  // namespace

void carry_fields(const Input &input, const Options &options, const Original &original, Span<const std::int32_t> solids,
                  const Boundary &boundary, Job &job, Result &result) {
  if (input.fields.empty()) return;
  MeshView view = original.view;
  view.solid = solids;
  Array<Vec3> copy(&job.memory);
  const Span<const Vec3> points = original.in_scale(result.mesh.points, copy);
  Array<std::int32_t> sources(&job.memory);
  if (any_of_association(input, Association::point))
    find_stencils(view, boundary.triangles, points, result.mesh.solid, options.tet_leaf, job, result.stencil);
  if (any_of_association(input, Association::cell))
    sources = Sources(options, original, view, boundary, job)
                  .find(find_centroids(points, result.mesh.tets, job), solids_of_tets(result.mesh, job));
  for (const SubmittedField &field : input.fields) {
    if (field.association == Association::point)
      carry_along(result.stencil, result.mesh.points.size(), field, job, result);
    else
      carry_along(Span<const std::int32_t>(sources), result.mesh.tets.size(), field, job, result);
  }
}

void split_fields(const Input &input, Job &job, Result &result) {
  if (input.steering.empty()) return;
  const std::size_t fields = input.steering_fields(), points = result.mesh.points.size();
  const Array<double> together = std::move(result.mesh.scalars);
  const auto take = [&](std::size_t k, Array<double> &values) {
    values.clear();
    values.reserve(points);
    for (std::size_t v = 0; v < points; v++) values.push_back(together[v * fields + k]);
  };
  take(0, result.mesh.scalars);
  for (std::size_t k = 1; k < fields; k++) {
    const SteeringField &field = input.steering[k - 1];
    take(k, result.fields.emplace_back(field.name, Association::point, field.values.type, 1, job.memory).values);
  }
}

void find_stencil(const Input &input, const Options &options, Prepared &prepared, Job &job, Result &result) {
  if (!result.stencil.ids.empty()) return;
  Prepared fresh(job.memory);
  Prepared &of = as_in_its_run(input, options, result, prepared, fresh, job);
  MeshView view = of.original.view;
  if (!result.mesh.solid.empty()) view.solid = of.solids(job);
  Array<Vec3> copy(&job.memory);
  Stencil stencil(job.memory);
  find_stencils(view, of.boundary.triangles, of.original.in_scale(result.mesh.points, copy), result.mesh.solid,
                options.tet_leaf, job, stencil);
  result.stencil = std::move(stencil);
}

}  // namespace tetlod
