#include "footprint.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "adaptive_mesh.hpp"
#include "attempts.hpp"
#include "place_probes.hpp"
#include "surface_distance.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

// Of decimation and of what a result is made from.
constexpr double bytes_a_triangle = 530, bytes_a_result_point = 360;
// Of a boundary whose decimation sees the field, beside these; and for each field more.
constexpr double quadric_a_triangle = 90, values_a_triangle = 9;
// Where the solid's edges collapse, the boundary is decimated only if that leads to no sound mesh: between the two, and
// so that a plate's estimate is not too large.
constexpr double seldom_a_triangle = 390, seldom_values_a_triangle = 4;
// Of the original while its edges collapse.
constexpr double bytes_a_solid_tet = 67, bytes_a_solid_point = 54, bytes_a_solid_triangle = 157,
                 bytes_of_collapses = 8e4;
// Beside either, where the deviation is limited: samples, their lists, and a tree; of six sets.
constexpr double bytes_a_limited_triangle = 240;
// Of a run with a target: neighbours, frames or normal equations, and room to grow; of the original's boundary.
constexpr double bytes_a_refined_tet = 164, bytes_a_refined_triangle = 171, bytes_a_probe = sizeof(Probe<1>) + 8;
// Where vertices come and go in rounds, and arrays grow; a result aside, in arrays that grew.
constexpr double rounds_a_refined_tet = 50, grown = 3;
// Of these for each field more that steers.
constexpr double values_a_refined_tet = 4, values_a_solid_point = 8;
// Of a field.
constexpr double bytes_a_located_point = 400, bytes_a_located_cell = 190, bytes_a_stencil = 48;

/// Bytes at a vertex, of the fields after the first.
double more_values(const Outlook &outlook) { return sizeof(double) * (outlook.fields - 1); }

/// Of a result, and of what it is written to.
double bytes_of_result(const Outlook &outlook) { return 32 * outlook.points + 16 * outlook.tets; }

double bytes_of_limit(const Outlook &outlook) {
  return outlook.limits_deviation ? bytes_a_limited_triangle * outlook.boundary_triangles : 0;
}

double bytes_of_decimation(const Outlook &outlook) {
  double a_triangle = bytes_a_triangle;
  if (outlook.solid_tets > 0)
    a_triangle = seldom_a_triangle + seldom_values_a_triangle * more_values(outlook);
  else if (outlook.probes > 0)
    a_triangle += quadric_a_triangle + values_a_triangle * more_values(outlook);
  return a_triangle * outlook.boundary_triangles + bytes_of_limit(outlook);
}

double bytes_of_collapsing(const Outlook &outlook) {
  if (!(outlook.solid_tets > 0)) return 0;
  return bytes_a_solid_tet * outlook.solid_tets +
         (bytes_a_solid_point + values_a_solid_point * more_values(outlook)) * outlook.solid_points +
         bytes_a_solid_triangle * outlook.boundary_triangles + bytes_of_limit(outlook) + bytes_of_collapses;
}

double bytes_of_fields(const Outlook &outlook, const Input &input) {
  double values = 0;
  bool of_points = false, of_cells = false;
  for (const SubmittedField &field : input.fields) {
    const bool cells = field.association == Association::cell;
    (cells ? of_cells : of_points) = true;
    values += double(sizeof(double)) * field.values.components * (cells ? outlook.tets : outlook.points);
  }
  const double points = of_points ? outlook.points : 0, cells = of_cells ? outlook.tets : 0;
  return bytes_of_result(outlook) +
         std::max({bytes_a_located_point * points, bytes_a_stencil * points + bytes_a_located_cell * cells,
                   bytes_a_stencil * points + values});
}

double bytes_of_refining(const Outlook &outlook) {
  if (!(outlook.probes > 0)) return 0;
  const double of_rounds = outlook.has_rounds ? rounds_a_refined_tet : 0;
  return (bytes_a_refined_tet + of_rounds + values_a_refined_tet * more_values(outlook)) * outlook.tets +
         (bytes_a_probe + more_values(outlook)) * outlook.probes +
         bytes_a_refined_triangle * outlook.boundary_triangles +
         outlook.results_aside * grown * bytes_of_result(outlook);
}

/// visit(v) for each vertex; of all of a large mesh that takes longer than a host is to wait.
template <class Visit>
void for_vertices(Span<const std::int32_t> vertices, Job &job, const Visit &visit) {
  for (std::size_t i = 0; i < vertices.size(); i++) {
    job.poll_at(i + 1, 0.5);
    visit(vertices[i]);
  }
}

/// Largest distance of the values of some vertices from the linear function that fits them best.
double off_linear(const MeshView &mesh, std::size_t field, Span<const std::int32_t> vertices, Job &job) {
  const auto value_of = [&](std::int32_t v) { return mesh.scalars[std::size_t(v) * mesh.fields + field]; };
  const auto n = double(vertices.size());
  Vec3 mean(0);
  double value = 0;
  for_vertices(vertices, job, [&](std::int32_t v) {
    mean += mesh.points[std::size_t(v)] / n;
    value += value_of(v) / n;
  });
  glm::dmat3 square(0);
  Vec3 right(0);
  for_vertices(vertices, job, [&](std::int32_t v) {
    const Vec3 d = mesh.points[std::size_t(v)] - mean;
    square += glm::outerProduct(d, d);
    right += (value_of(v) - value) * d;
  });
  const double damping = 1e-6 * (square[0][0] + square[1][1] + square[2][2]);
  for (int k = 0; k < 3; k++) square[k][k] += damping;
  const Vec3 gradient = glm::inverse(square) * right;
  double worst = 0;
  for_vertices(vertices, job, [&](std::int32_t v) {
    worst = std::max(worst, std::abs(value_of(v) - value - glm::dot(gradient, mesh.points[std::size_t(v)] - mean)));
  });
  return worst;
}

/// The same of all fields, as if all ranges were the first's.
double off_linear(const MeshView &mesh, Span<const std::int32_t> vertices, Job &job) {
  double worst = 0;
  for (std::size_t k = 0; k < mesh.fields; k++)
    worst = std::max(worst, mesh.scales.relative[k] * off_linear(mesh, k, vertices, job));
  return worst;
}

/// About the longest axis, at the median.
std::size_t halve(const MeshView &mesh, Span<std::int32_t> vertices, Job &job) {
  Box box;
  for_vertices({vertices.data(), vertices.size()}, job, [&](std::int32_t v) { box.add(mesh.points[std::size_t(v)]); });
  const int axis = box.longest_axis();
  const std::size_t middle = vertices.size() / 2;
  std::nth_element(vertices.begin(), vertices.begin() + std::ptrdiff_t(middle), vertices.end(),
                   [&](std::int32_t a, std::int32_t b) {
                     const double x = mesh.points[std::size_t(a)][axis], y = mesh.points[std::size_t(b)][axis];
                     return x != y ? x < y : a < b;
                   });
  return middle;
}

std::size_t count_linear_parts(const MeshView &mesh, Span<std::int32_t> vertices, double bound, Job &job) {
  constexpr std::size_t too_few = 5;  // a linear function fits them
  job.poll(0.5);
  if (vertices.size() < too_few || off_linear(mesh, {vertices.data(), vertices.size()}, job) <= bound) return 1;
  const std::size_t middle = halve(mesh, vertices, job);
  return count_linear_parts(mesh, {vertices.data(), middle}, bound, job) +
         count_linear_parts(mesh, {vertices.data() + middle, vertices.size() - middle}, bound, job);
}

/// Share of the samples, out of some of them, that the original's boundary is not nearer to than `least`.
double share_away(Span<const Vec3> points, Span<const Triangle> boundary, Span<const std::int32_t> samples,
                  double least, Job &job) {
  constexpr std::size_t enough = 1000;
  const TriangleTree nearest(points, boundary, job);
  const std::size_t step = samples.size() / enough + 1;
  std::size_t asked = 0, away = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    if (asked++ % 64 == 0) job.poll(0.5);
    away += nearest.nearest(points[std::size_t(samples[i])]).distance >= least;
  }
  return asked ? double(away) / double(asked) : 1;
}

/// How many tets a bound of the error takes, more or less: by the number of parts into which the vertices are to be
/// divided until in none the values are off by more than `bound` from a linear function. 0: there is no bound.
double tets_for_bound(const MeshView &mesh, double bound, Job &job) {
  if (!(bound > 0)) return 0;
  Array<std::int32_t> vertices = used_vertices(mesh, job);
  const std::size_t parts = count_linear_parts(mesh, {vertices.data(), vertices.size()}, bound, job);
  return std::min(tets_a_part * double(parts), double(mesh.tets.size()));
}

}  // namespace

double expected_bytes(const Outlook &outlook, const Input &input) {
  return std::max({bytes_of_decimation(outlook), bytes_of_collapsing(outlook), bytes_a_result_point * outlook.points,
                   bytes_of_refining(outlook), input.fields.empty() ? 0 : bytes_of_fields(outlook, input)});
}

std::size_t bytes_to_refine(const MeshView &original, std::int64_t tets, int rounds) {
  Outlook of;
  of.tets = double(tets);
  of.fields = double(original.fields);
  of.has_rounds = rounds > 0;
  of.probes = double(expected_probes(original, enough_probes(of.tets, rounds, true)));
  return std::size_t(bytes_of_refining(of));
}

Outlook outlook_of(const Original &original, const Boundary &boundary, Span<const std::int32_t> samples,
                   const Options &options, const Budget &budget, const Report &report, Job &job) {
  Outlook of;
  of.boundary_triangles = double(boundary.triangles.size());
  of.limits_deviation = options.max_deviation > 0;
  if (as_published(options)) {
    const double least = options.min_distance * original.box.diagonal();
    const double away =
        share_away(original.view.points, boundary.triangles, samples, least, job) * double(samples.size());
    const double of_boundary = options.sigma * of.boundary_triangles / 2;
    of.points = of_boundary + away;
    of.tets = tets_a_boundary_point * of_boundary + tets_a_sample * away;
    return of;
  }
  if (collapses_edges(options, report)) {
    of.solid_tets = double(original.view.tets.size());
    of.solid_points = double(original.view.points.size()) - double(boundary.unused_points);
  }
  of.fields = double(original.view.fields);
  of.tets = std::max(double(budget.tets), tets_for_bound(original.view, options.max_error * original.range, job));
  of.points = of.tets / tets_a_point;
  const double first = std::max(double(budget.tets), std::min(of.tets, double(budget.enough)));
  const int rounds = rounds_of(options, report);
  of.has_rounds = rounds > 0;
  const bool refines = options.max_error > 0 || !keeps_all(budget, report) || report.moved_points > 0 ||
                       !collapses_edges(options, report);
  of.probes = refines ? double(expected_probes(original.view, enough_probes(first, rounds, true))) : 0;
  of.results_aside = weights_of_attempts(budget, options, report).empty() ? 0 : 1;
  return of;
}

}  // namespace tetlod
