#include "prepare.hpp"

#include <algorithm>
#include <cmath>

#include "conforming.hpp"
#include "field_jumps.hpp"
#include "first_culprit.hpp"
#include "geometry.hpp"
#include "measure_ranges.hpp"
#include "merge_coincident.hpp"
#include "merged_values.hpp"
#include "nested_solids.hpp"
#include "status.hpp"
#include "untangle.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

constexpr std::size_t block = 1 << 14;

bool interleaved_doubles(const std::array<StridedArray, 3> &xyz) {
  for (std::size_t k = 0; k < 3; k++)
    if (xyz[k].type != ElementType::float64 || xyz[k].tuple_stride != std::int64_t(sizeof(Vec3)) ||
        xyz[k].data != xyz[0].data + k * sizeof(double))
      return false;
  return true;
}

Span<const Vec3> read_points(const Input &input, Job &job, Array<Vec3> &copy) {
  const auto count = std::size_t(input.xyz[0].tuples);
  if (interleaved_doubles(input.xyz)) return {reinterpret_cast<const Vec3 *>(input.xyz[0].data), count};
  grow(copy, count, job);
  job.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      for (int k = 0; k < 3; k++) copy[i][k] = input.xyz[std::size_t(k)].real(std::int64_t(i), 0);
    job.poll(0);
  });
  return copy;
}

Span<const double> read_scalars(const Input &input, Job &job, Array<double> &copy) {
  const auto count = std::size_t(input.scalars.tuples);
  if (input.steering.empty() && input.scalars.packed_as(ElementType::float64))
    return {reinterpret_cast<const double *>(input.scalars.data), count};
  const std::size_t fields = input.steering_fields();
  grow(copy, count * fields, job);
  job.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < fields; k++) {
      const StridedArray &field = k == 0 ? input.scalars : input.steering[k - 1].values;
      for (std::size_t i = begin; i < end; i++) copy[i * fields + k] = field.real(std::int64_t(i), 0);
    }
    job.poll(0);
  });
  return copy;
}

void read_values(const Input &input, Job &job, Original &original) {
  original.view.scalars = {};
  original.scalars = Array<double>(original.scalars.get_allocator());  // of earlier values
  original.view.scalars = read_scalars(input, job, original.scalars);
  original.view.fields = input.steering_fields();
}

/// The first field with a value that is not finite at vertex v; else the number of fields.
std::size_t first_nonfinite(const MeshView &mesh, std::size_t v) {
  std::size_t k = 0;
  while (k < mesh.fields && std::isfinite(mesh.scalars[v * mesh.fields + k])) k++;
  return k;
}

void check_indices(const Input &input, Job &job) {
  const auto count = std::size_t(input.tets.tuples);
  const std::int64_t points = input.xyz[0].tuples, base = input.index_base;
  FirstCulprit culprit;
  job.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      for (int k = 0; k < 4; k++) {
        const std::int64_t v = input.tets.integer(std::int64_t(t), k);
        if (v < base || v - base >= points) culprit.report(t);
      }
    job.poll(double(end) / double(count));
  });
  if (!culprit.any()) return;
  for (int k = 0; k < 4; k++) {
    const std::int64_t v = input.tets.integer(std::int64_t(culprit.index()), k);
    if (v < base || v - base >= points)
      fail(Status::mesh_index, "tet %lld uses vertex %lld, the mesh has %lld (numbered from %d)",
           static_cast<long long>(culprit.index()) + base, static_cast<long long>(v), static_cast<long long>(points),
           int(base));
  }
}

Span<const Tet> read_tets(const Input &input, Job &job, Array<Tet> &copy) {
  check_indices(input, job);
  const auto count = std::size_t(input.tets.tuples);
  if (input.index_base == 0 && input.tets.packed_as(ElementType::int32))
    return {reinterpret_cast<const Tet *>(input.tets.data), count};
  grow(copy, count, job);
  job.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      for (int k = 0; k < 4; k++)
        copy[t][std::size_t(k)] = std::int32_t(input.tets.integer(std::int64_t(t), k) - input.index_base);
    job.poll(0.5);
  });
  return copy;
}

/// That of a field at vertex v, the first one.
[[noreturn]] void refuse_value(const Input &input, const Original &original, std::size_t v, std::size_t field,
                               Job &job) {
  const MeshView &mesh = original.view;
  std::size_t more = 0;
  for (std::size_t u = v + 1; u < original.used.size(); u++) {
    job.poll_at(u, 0.5);
    more += original.used[u] && first_nonfinite(mesh, u) < mesh.fields;
  }
  const std::string name = input.name_of_steering(field).substr(0, 100);
  fail(Status::mesh_nonfinite, "the value %sof vertex %zu is %s%s (on-nonfinite: error)",
       name.empty() ? "" : ("of field " + name + " ").c_str(), v + std::size_t(input.index_base),
       number(mesh.scalars[v * mesh.fields + field]).c_str(),
       more ? text(", and %zu more vertices have none", more).c_str() : "");
}

/// Looks at the coordinates and values of the points that tets use. Points without a finite value are marked as not
/// used, or refused. Returns the others' box.
Box check_used_points(const Input &input, const Options &options, Job &job, Original &original) {
  const MeshView &mesh = original.view;
  Array<std::uint8_t> &used = original.used;
  Box box;
  for (std::size_t v = 0; v < used.size(); v++) {
    job.poll_at(v, 0.5);
    if (!used[v]) continue;
    for (int k = 0; k < 3; k++)
      if (!std::isfinite(mesh.points[v][k]))
        fail(Status::mesh_nonfinite, "coordinate %c of vertex %zu is %s", "xyz"[k], v + std::size_t(input.index_base),
             number(mesh.points[v][k]).c_str());
    if (const std::size_t k = first_nonfinite(mesh, v); k < mesh.fields) {
      if (options.on_nonfinite == policy_error) refuse_value(input, original, v, k, job);
      used[v] = 0;
      original.nonfinite_points++;
      continue;
    }
    box.add(mesh.points[v]);
  }
  return box;
}

/// These, with their numbers among the submitted ones, instead of those that the view has.
void take_tets(Array<Tet> &&tets, Array<std::int32_t> &&numbers, Job &job, Original &original) {
  original.tets = std::move(tets);
  original.tet_number = std::move(numbers);
  original.view.tets = original.tets;
  original.left = find_used(original.view.tets, original.view.points.size(), job);
  original.view.used = original.left;
}

/// Renames merged vertices and leaves out the tets that have a vertex twice or one that is not used.
void drop_and_rename(Span<const std::int32_t> representative, Job &job, Original &original) {
  Array<Tet> kept(&job.memory);
  Array<std::int32_t> numbers(&job.memory);
  kept.reserve(original.view.tets.size());
  numbers.reserve(original.view.tets.size());
  for (std::size_t i = 0; i < original.view.tets.size(); i++) {
    job.poll_at(i, 0.9);
    const Tet &t = original.view.tets[i];
    if (std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return !original.used[std::size_t(v)]; })) continue;
    Tet renamed = t;
    for (std::int32_t &v : renamed) v = representative[std::size_t(v)];
    if (has_repeated_vertex(renamed)) continue;
    kept.push_back(renamed);
    numbers.push_back(std::int32_t(i));
  }
  original.dropped_tets = std::int64_t(original.view.tets.size() - kept.size());
  take_tets(std::move(kept), std::move(numbers), job, original);
}

/// Returns what becomes of the box.
Box scale_extreme_coordinates(const Box &box, Job &job, Original &original) {
  const int exponent = extreme_exponent(box);
  if (exponent == 0) return box;
  original.exponent = exponent;
  const auto scaled = [&](const Vec3 &p) { return times_power_of_two(p, -exponent); };
  Array<Vec3> points = array_of(original.view.points.size(), Vec3(0), job);
  for_each(points.size(), job, [&](std::size_t v) { points[v] = scaled(original.view.points[v]); });
  original.points = std::move(points);
  original.view.points = original.points;
  return {scaled(box.low), scaled(box.high)};
}

/// In an array of its own.
void move_points(const Moves &moves, Job &job, Original &original) {
  if (moves.empty()) return;
  if (original.points.empty()) {
    grow(original.points, original.view.points.size(), job);
    for_each(original.points.size(), job, [&](std::size_t v) { original.points[v] = original.view.points[v]; });
    original.view.points = original.points;
  }
  for (const Move &move : moves) original.points[std::size_t(move.vertex)] = move.to;
}

void take_cracks(Moves &&opened, Job &job, Original &original) {
  for (const Move &move : opened)
    original.boundary_moved_by =
        std::max(original.boundary_moved_by, glm::distance(original.view.points[std::size_t(move.vertex)], move.to));
  move_points(opened, job, original);
  original.moves.opened = std::move(opened);
}

void read_flags(const Input &input, Span<const std::int32_t> representative, Job &job, Original &original) {
  if (!input.flags.present) return;
  original.flags.assign(representative.size(), 0);
  for (std::size_t v = 0; v < representative.size(); v++) {
    job.poll_at(v, 0.9);
    const auto flags = input.flags.at<std::uint8_t>(std::int64_t(v), 0);
    if (flags > (keep_vertex | lock_vertex))
      fail(Status::argument, "the flags of vertex %zu are %d, of which not all have a meaning",
           v + std::size_t(input.index_base), int(flags));
    original.flags[std::size_t(representative[v])] |= flags;
  }
}

bool any_repeated_vertex(Span<const Tet> tets, Job &job) {
  FirstCulprit culprit;
  job.parallel.for_blocks(tets.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      if (has_repeated_vertex(tets[t])) culprit.report(t);
    job.poll(0.9);
  });
  return culprit.any();
}

void drop_excluded(Job &job, Boundary &boundary, Original &original) {
  Array<Tet> kept(&job.memory);
  Array<std::int32_t> numbers(&job.memory), renamed = array_of(original.view.tets.size(), -1, job);
  for (std::size_t t = 0; t < renamed.size(); t++) {
    job.poll_at(t, 0.9);
    if (boundary.excluded[t]) continue;
    renamed[t] = std::int32_t(kept.size());
    kept.push_back(original.view.tets[t]);
    numbers.push_back(original.tet_number.empty() ? std::int32_t(t) : original.tet_number[t]);
  }
  take_tets(std::move(kept), std::move(numbers), job, original);
  for (std::int32_t &t : boundary.tet_of) t = renamed[std::size_t(t)];
  boundary.excluded.clear();
}

/// Prepares the mesh anew.
void close_cracks(const Input &input, const Options &options, Job &job, Original &original, Boundary &boundary) {
  Jumps jumps = std::move(original.jumps);
  const PointMoves none(job.memory);
  original = Original(job.memory);
  boundary = Boundary(job.memory);
  prepare_original(input, options, job, original, &none);
  original.jumps = std::move(jumps);
  prepare_boundary(input, options, job, original, boundary);
}

void require_a_value_a_point(const Input &input) {
  const auto points = static_cast<long long>(input.xyz[0].tuples),
             values = static_cast<long long>(input.scalars.tuples);
  if (values != points)
    fail(Status::argument, "scalars%s%.100s: %lld values for %lld points", input.scalars_name.empty() ? "" : " ",
         input.scalars_name.c_str(), values, points);
  if (input.flags.present && input.flags.tuples != points)
    fail(Status::argument, "%lld flags for %lld points", static_cast<long long>(input.flags.tuples), points);
}

}  // namespace

void check_count(const Input &input, const std::string &field, std::int64_t tuples, Association association) {
  const bool of_cells = association == Association::cell;
  const std::int64_t count = of_cells ? input.tets.tuples : input.xyz[0].tuples;
  if (tuples != count)
    fail(Status::argument, "field %.100s: %lld tuples for %lld %s", field.c_str(), static_cast<long long>(tuples),
         static_cast<long long>(count), of_cells ? "tets" : "points");
}

void check_counts(const Input &input) {
  const std::int64_t points = input.xyz[0].tuples, tets = input.tets.tuples;
  require_a_value_a_point(input);
  for (const SteeringField &field : input.steering)
    check_count(input, field.name, field.values.tuples, Association::point);
  if (points == 0 || tets == 0)
    fail(Status::mesh_empty, "the mesh has %lld points and %lld tets", static_cast<long long>(points),
         static_cast<long long>(tets));
  if (std::max(points, tets) > max_count)
    fail(Status::mesh_too_large, "%lld points or tets, the most is %lld",
         static_cast<long long>(std::max(points, tets)), static_cast<long long>(max_count));
}

int extreme_exponent(const Box &box) {
  constexpr int far_from_one = 100;
  const double most = box.largest_coordinate();
  const int exponent = most > 0 && std::isfinite(most) ? std::ilogb(most) : 0;
  return std::abs(exponent) > far_from_one ? exponent : 0;
}

void prepare_original(const Input &input, const Options &options, Job &job, Original &original,
                      const PointMoves *made) {
  check_counts(input);
  original.index_base = input.index_base;
  original.view.points = read_points(input, job, original.points);
  read_values(input, job, original);
  original.view.tets = read_tets(input, job, original.tets);
  original.used = find_used(original.view.tets, original.view.points.size(), job);
  original.view.used = original.used;
  const Box submitted = scale_extreme_coordinates(check_used_points(input, options, job, original), job, original);

  // The diagonal here is that of what was submitted: which tets are left is not known before points are merged.
  Array<std::int32_t> representative(&job.memory);
  Merged merged = merge_coincident(input, original.view.points, original.view.tets, original.used, submitted, options,
                                   job, representative, made ? &made->opened : nullptr);
  original.merged_points = merged.points;
  if (merged.points > 0) original.next_merged = chain_merged(representative, job);
  original.merging_depends = merged.depends;
  original.jumps = std::move(merged.asked);
  original.torn = std::move(merged.torn);
  take_cracks(std::move(merged.cracks.opened), job, original);
  read_flags(input, representative, job, original);
  Array<FlaggedPoint> &flagged = original.moves.flagged;
  if (made && !input.flags.present)
    flagged.assign(made->flagged.begin(), made->flagged.end());
  else
    flagged = find_flagged(input, job, original);
  move_points(moves_to_flagged(flagged, original.view.points, job.memory), job, original);
  if (original.merged_points || original.nonfinite_points || any_repeated_vertex(original.view.tets, job))
    drop_and_rename(representative, job, original);
  if (original.view.tets.empty())
    fail(Status::mesh_empty, "none of the %lld tets has four different vertices with a value",
         static_cast<long long>(input.tets.tuples));
  measure_ranges(input, job, original);
}

void prepare_boundary(const Input &input, const Options &options, Job &job, Original &original, Boundary &boundary,
                      const PointMoves *made) {
  extract_boundary(original.view, job, boundary, original.numbers());
  const bool are_dropped = !boundary.excluded.empty(), are_merged = original.merged_points > 0;
  if (are_dropped) drop_excluded(job, boundary, original);
  if (are_merged) {  // values of tets that were dropped do not count
    find_points_that_count(input, job, original);
    take_merged_values(job, original);
  }
  const bool repairs = options.on_overlap == policy_repair;
  if (repairs && made) make_moves(made->upright, job, boundary, original);
  if (repairs && !made) make_moves(find_moves(original, boundary, job), job, boundary, original);
  if (are_dropped || are_merged || !original.moves.upright.empty()) measure_ranges(input, job, original);
  if (repairs) make_conforming(job, boundary, original);
  if (!made && !original.moves.opened.empty() &&
      !is_sound(original.view, boundary.triangles, MayTouch::other_solids, job))
    close_cracks(input, options, job, original, boundary);
}

void prepare_with_boundary(const Input &input, const Options &options, Job &job, Original &original, Boundary &boundary,
                           const PointMoves *made) {
  prepare_original(input, options, job, original, made);
  prepare_boundary(input, options, job, original, boundary, made);
}

bool renew_values(const Input &input, Job &job, Original &original) {
  check_counts(input);
  if (original.nonfinite_points > 0 || !are_same_jumps(original.jumps, input, original.used, job)) return false;
  const auto points = std::size_t(input.xyz[0].tuples), tets = std::size_t(input.tets.tuples);
  if (original.points.empty() && !interleaved_doubles(input.xyz)) return false;
  if (original.points.empty()) {
    const Span<const Vec3> submitted(reinterpret_cast<const Vec3 *>(input.xyz[0].data), points);
    (original.moved.empty() ? original.view.points : original.view.submitted) = submitted;
  }
  if (original.tets.empty()) original.view.tets = {reinterpret_cast<const Tet *>(input.tets.data), tets};
  read_values(input, job, original);
  for (std::size_t v = 0; v < points; v++) {
    job.poll_at(v, 0.5);
    if (original.used[v] && first_nonfinite(original.view, v) < original.view.fields) return false;
  }
  take_merged_values(job, original);
  measure_ranges(input, job, original);
  return true;
}

bool has_finite_values(const Input &input, std::int64_t point) {
  const auto is_finite = [point](const StridedArray &values) {
    return point >= values.tuples || std::isfinite(values.real(point, 0));
  };
  return is_finite(input.scalars) && std::all_of(input.steering.begin(), input.steering.end(),
                                                 [&](const SteeringField &field) { return is_finite(field.values); });
}

}  // namespace tetlod
