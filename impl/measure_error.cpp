#include "measure_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry.hpp"
#include "in_its_run.hpp"
#include "kd_tree.hpp"
#include "random_place.hpp"
#include "solids.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

constexpr std::size_t block = 512;

/// At weights w in t, of the first of `fields` at each vertex. Not beyond the values at the corners: a constant stays
/// what it is, however large.
double value_in(Span<const double> scalars, std::size_t fields, const Tet &t, const double w[4]) {
  const auto at_corner = [&](std::size_t k) { return scalars[std::size_t(t[k]) * fields]; };
  double sum = 0, low = at_corner(0), high = low;
  for (std::size_t k = 0; k < 4; k++) {
    sum += w[k] * at_corner(k);
    low = std::min(low, at_corner(k));
    high = std::max(high, at_corner(k));
  }
  return std::clamp(sum, low, high);
}

/// The result's piecewise linear field.
class Field {
 public:
  /// points: the mesh's, in another scale perhaps.
  Field(const TetMesh &mesh, Span<const Vec3> points, Job &job) : mesh_(mesh), points_(points), tree_(job.memory) {
    const auto box = [&](std::size_t t) { return with_rounding(box_of<4>(points, mesh.tets[t])); };
    tree_.build(boxes_of(mesh.tets.size(), job, box), 4, job);
  }

  /// Of a point of that solid, where the mesh says of several.
  bool value_at(const Vec3 &p, std::int32_t solid, double &value) const {
    double best = -out_by_rounding;
    bool found = false;
    tree_.any_overlap({p, p}, [&](std::int32_t item) {
      const Tet &t = mesh_.tets[std::size_t(item)];
      if (!mesh_.solid.empty() && !may_be_one(solid, solid_of(mesh_.solid, t))) return false;
      double w[4];
      const auto at = [&](std::size_t k) -> const Vec3 & { return points_[std::size_t(t[k])]; };
      if (!barycentric(p, at(0), at(1), at(2), at(3), w)) return false;
      const double least = std::min({w[0], w[1], w[2], w[3]});
      if (least > best) {
        best = least;
        found = true;
        value = value_in(mesh_.scalars, 1, t, w);
      }
      return best >= 0;
    });
    return found;
  }

 private:
  const TetMesh &mesh_;
  Span<const Vec3> points_;
  KdTree tree_;
};

/// Sums of one block; blocks are added up in order, so the total does not depend on threads.
struct Tally {
  double squares = 0, worst = 0;
  std::int64_t inside = 0, outside = 0;

  /// The error in units, each value by itself: their difference may be more than a double holds.
  void add(const Field &field, const Vec3 &p, std::int32_t solid, double original, double unit) {
    double value;
    if (!field.value_at(p, solid, value)) {
      outside++;
      return;
    }
    const double error = std::abs(value / unit - original / unit);
    squares += error * error;
    worst = std::max(worst, error);
    inside++;
  }
  void add(const Tally &o) {
    squares += o.squares;
    worst = std::max(worst, o.worst);
    inside += o.inside;
    outside += o.outside;
  }
  double rms() const { return inside ? std::sqrt(squares / double(inside)) : 0; }
  double share_outside() const { return inside + outside ? double(outside) / double(inside + outside) : 0; }
};

template <class Add>
Tally tally_blocks(std::size_t count, Job &job, double begin_fraction, const Add &add) {
  Array<Tally> tallies((count + block - 1) / block, &job.memory);
  job.parallel.for_blocks(count, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) add(i, tallies[begin / block]);
    job.poll(begin_fraction + 0.5 * double(end) / double(count));
  });
  Tally total;
  for (const Tally &t : tallies) total.add(t);
  return total;
}

/// A sample at a random place of the tet.
void add_sample(const MeshView &mesh, std::size_t tet, std::uint64_t key, const Field &field, double unit,
                Tally &tally) {
  double weights[4];
  random_weights(key, weights);
  Vec3 p(0);
  for (std::size_t k = 0; k < 4; k++) p += weights[k] * mesh.points[std::size_t(mesh.tets[tet][k])];
  const std::int32_t solid = mesh.solid.empty() ? -1 : solid_of(mesh.solid, mesh.tets[tet]);
  tally.add(field, p, solid, value_in(mesh.scalars, mesh.fields, mesh.tets[tet], weights), unit);
}

/// values(v, visit): visits those that were submitted for vertex v.
template <class ValuesOf>
FieldError measure(const MeshView &original, const ValuesOf &values, double range, const Field &field,
                   int samples_per_tet, std::uint64_t seed, Job &job) {
  const double unit = range > 0 ? std::min(range, std::numeric_limits<double>::max()) : 1;
  Array<std::uint8_t> room(&job.memory);
  const Span<const std::uint8_t> used = used_points(original, job, room);
  const Tally at_vertices = tally_blocks(original.points.size(), job, 0, [&](std::size_t v, Tally &tally) {
    const std::int32_t solid = original.solid.empty() ? -1 : original.solid[v];
    if (used[v]) values(v, [&](double value) { tally.add(field, original.place(v), solid, value, unit); });
  });
  const auto samples = std::uint64_t(samples_per_tet);
  const std::uint64_t first = (seed << 40) ^ (seed >> 24) * 0x9e3779b97f4a7c15u;  // seeds do not share samples
  const Tally inside = tally_blocks(samples ? original.tets.size() : 0, job, 0.5, [&](std::size_t t, Tally &tally) {
    for (std::uint64_t s = 0; s < samples; s++)
      add_sample(original, t, first + std::uint64_t(t) * samples + s, field, unit, tally);
  });
  return {at_vertices.rms(), at_vertices.worst, at_vertices.share_outside(),
          inside.rms(),      inside.worst,      inside.share_outside()};
}

}  // namespace

FieldError measure_error(const MeshView &original, double range, const TetMesh &result, int samples_per_tet,
                         std::uint64_t seed, Job &job) {
  const auto value_of = [&](std::size_t v, const auto &visit) { visit(original.scalars[v * original.fields]); };
  return measure(original, value_of, range, Field(result, result.points, job), samples_per_tet, seed, job);
}

FieldError measure_error(const Input &input, const Options &options, const Result &result, int samples_per_tet,
                         Prepared &prepared, Job &job) {
  Prepared fresh(job.memory);
  Prepared &of = as_in_its_run(input, options, result, prepared, fresh, job);
  job.enter(Stage::values);
  const Original &original = of.original;
  MeshView view = original.view;
  if (!result.mesh.solid.empty()) view.solid = of.solids(job);
  const auto values_of = [&](std::size_t v, const auto &visit) {
    if (!original.has_merged(v)) return visit(view.scalars[v * view.fields]);
    original.for_each_merged(v, [&](std::size_t u) { visit(input.scalars.real(std::int64_t(u), 0)); });
  };
  Array<Vec3> copy(&job.memory);
  const Field field(result.mesh, original.in_scale(result.mesh.points, copy), job);
  return measure(view, values_of, original.scalar_max - original.scalar_min, field, samples_per_tet,
                 std::uint64_t(options.seed), job);
}

void histogram(Span<const double> values, double low, double high, Span<std::int64_t> counts) {
  const double part = std::isfinite(high - low) ? 1 : 0.5;  // of values, so that their range is a double
  const double width = (part * high - part * low) / double(counts.size());
  for (double value : values) {
    if (!(value >= low && value <= high)) continue;
    const double bin = width > 0 ? (part * value - part * low) / width : 0;
    counts[std::min(std::size_t(bin), counts.size() - 1)]++;
  }
}

}  // namespace tetlod
