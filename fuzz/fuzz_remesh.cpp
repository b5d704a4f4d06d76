// The remesher alone: surfaces that no decimation would hand it, and samples anywhere.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "demand.hpp"
#include "oracle.hpp"
#include "remesh.hpp"
#include "stages.hpp"

namespace fuzz {

namespace {

using tetlod::Status;

/// What the remesher is given.
struct Problem {
  std::vector<Point> points;
  std::vector<Face> triangles;
  std::vector<Point> samples;
  std::size_t points_at_once = tetlod::usual_points_at_once;
  bool sound = false;  ///< whatever the samples are, as long as they are finite, there is a way
};

// ---- Surfaces ------------------------------------------------------------------------------------------------------

/// The boundary of a mesh, its points numbered by first use.
Problem surface_of(const Mesh &mesh) {
  Problem problem;
  problem.sound = mesh.sound;
  std::vector<std::int64_t> number(mesh.points.size(), -1);
  for (Face face : facts_of(mesh, {}).boundary) {
    for (std::int64_t &v : face) {
      std::int64_t &known = number[std::size_t(v)];
      if (known < 0) {
        known = std::int64_t(problem.points.size());
        problem.points.push_back(mesh.points[std::size_t(v)]);
      }
      v = known;
    }
    problem.triangles.push_back(face);
  }
  return problem;
}

Problem random_triangles(Bytes &in) {
  Problem problem;
  const std::size_t points = in.below(16), triangles = in.below(32);
  for (std::size_t i = 0; i < points; i++)
    problem.points.push_back({double(in.below(3)), double(in.below(3)), double(in.below(3))});
  for (std::size_t t = 0; t < triangles; t++)
    problem.triangles.push_back(
        {std::int64_t(in.below(points)), std::int64_t(in.below(points)), std::int64_t(in.below(points))});
  return problem;
}

// ---- Edits ---------------------------------------------------------------------------------------------------------

template <class T>
T &any_of(std::vector<T> &things, Bytes &in) {
  return things[in.below(things.size())];
}

void move_point(Problem &problem, Bytes &in) {
  Point &p = any_of(problem.points, in);
  if (in.one_in(2))
    p = any_of(problem.points, in);
  else
    p[in.below(3)] = in.one_in(2) ? in.real() : double(in.below(4));
}

void turn_over(Problem &problem, Bytes &in) {
  Face &face = any_of(problem.triangles, in);
  std::swap(face[0], face[1]);
}

void turn_all_over(Problem &problem, Bytes &) {
  for (Face &face : problem.triangles) std::swap(face[0], face[1]);
}

void drop_triangle(Problem &problem, Bytes &in) {
  problem.triangles.erase(problem.triangles.begin() + std::ptrdiff_t(in.below(problem.triangles.size())));
}

void double_triangle(Problem &problem, Bytes &in) { problem.triangles.push_back(Face(any_of(problem.triangles, in))); }

void retarget(Problem &problem, Bytes &in) {
  any_of(problem.triangles, in)[in.below(3)] = in.between(-1, std::int64_t(problem.points.size()));
}

void add_point(Problem &problem, Bytes &in) { problem.points.push_back({in.real(), in.real(), in.real()}); }

/// The same surface once more, somewhere else: beside, inside, across.
void add_copy(Problem &problem, Bytes &in) {
  const auto shift = std::int64_t(problem.points.size());
  const double factor = in.one_in(2) ? 1 : 0.25 + in.fraction();
  const Point offset = {3 * in.fraction(), 3 * in.fraction(), in.fraction()};
  const std::vector<Point> points = problem.points;
  const std::vector<Face> triangles = problem.triangles;
  for (const Point &p : points)
    problem.points.push_back({factor * p[0] + offset[0], factor * p[1] + offset[1], factor * p[2] + offset[2]});
  for (const Face &f : triangles) problem.triangles.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
}

using Edit = void (*)(Problem &, Bytes &);
constexpr Edit edits[] = {move_point,      move_point, turn_over, turn_all_over, drop_triangle,
                          double_triangle, retarget,   add_point, add_copy,      add_copy};

void edit(Problem &problem, Bytes &in) {
  for (std::size_t count = in.below(6) / 2; count > 0; count--) {
    if (problem.points.empty() || problem.triangles.empty()) return;
    edits[in.below(std::size(edits))](problem, in);
    problem.sound = false;
  }
}

// ---- Samples -------------------------------------------------------------------------------------------------------

Point between(const Point &a, const Point &b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// One after the other: a compiler may ask for arguments in any order.
Point between_two(const Problem &problem, Bytes &in, bool middle) {
  const Point &a = problem.points[in.below(problem.points.size())];
  const Point &b = problem.points[in.below(problem.points.size())];
  return between(a, b, middle ? 0.5 : in.fraction());
}

/// On a vertex, on an edge, somewhere in the hull, anywhere.
Point decode_sample(const Problem &problem, Bytes &in) {
  switch (in.below(6)) {
    case 0: return problem.points[in.below(problem.points.size())];
    case 1: return between_two(problem, in, true);
    case 2: return {in.real(), in.real(), in.real()};
    default: {
      const Point a = between_two(problem, in, false), b = between_two(problem, in, false);
      return between(a, b, in.fraction());
    }
  }
}

void decode_samples(Problem &problem, Bytes &in) {
  if (problem.points.empty()) return;
  for (std::size_t count = in.below(12); count > 0; count--) problem.samples.push_back(decode_sample(problem, in));
  for (const Point &p : problem.samples)
    for (const double x : p)
      if (!std::isfinite(x)) problem.sound = false;
}

Problem decode_problem(Bytes &in) {
  Problem problem = in.one_in(4) ? random_triangles(in) : surface_of(decode_mesh(in));
  edit(problem, in);
  decode_samples(problem, in);
  return problem;
}

// ---- The call ------------------------------------------------------------------------------------------------------

void fill(const Problem &problem, tetlod::Surface &surface) {
  for (const Point &p : problem.points) {
    surface.points.push_back({p[0], p[1], p[2]});
    surface.scalars.push_back(0);
    surface.origin.push_back(-1);
  }
  for (const Face &f : problem.triangles)
    surface.triangles.push_back({std::int32_t(f[0]), std::int32_t(f[1]), std::int32_t(f[2])});
}

bool same_place(const tetlod::Vec3 &p, const Point &q) { return p.x == q[0] && p.y == q[1] && p.z == q[2]; }

/// Surface, samples, Steiner points, in this order, the first two where they were.
void check_origins(const Problem &problem, const tetlod::RemeshResult &result) {
  const std::size_t boundary = problem.points.size();
  std::int64_t last = -1, steiner = 0;
  DEMAND(result.origin.size() == result.points.size() && result.points.size() >= boundary, "a point has an origin");
  for (std::size_t i = 0; i < result.points.size(); i++) {
    const std::int32_t origin = result.origin[i];
    if (i < boundary) DEMAND(origin == std::int32_t(i), "the surface's points come first");
    if (origin < 0) {
      steiner++;
      continue;
    }
    DEMAND(steiner == 0 && origin > last, "samples come in order, before Steiner points");
    last = origin;
    const auto known = std::size_t(origin);
    DEMAND(known < boundary + problem.samples.size(), "an origin is a point or a sample");
    DEMAND(same_place(result.points[i], known < boundary ? problem.points[known] : problem.samples[known - boundary]),
           "a point that was given stays where it is");
  }
  DEMAND(result.report.steiner_points == steiner, "Steiner points are counted");
  const auto kept = std::int64_t(result.points.size() - boundary) - steiner;
  DEMAND(result.report.dropped_samples == std::int64_t(problem.samples.size()) - kept, "dropped samples are counted");
}

void check_success(const Problem &problem, const tetlod::RemeshResult &result) {
  check_origins(problem, result);
  const std::vector<Point> points = points_of(result.points);
  const std::vector<Corners> tets = tets_of(result.tets);
  check_corners(tets, points.size());
  check_positive(points, tets);
  check_conforming(tets, problem.triangles);
}

void trace_problem(const Problem &problem) {
  for (const Point &p : problem.points) trace("v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
  for (const Face &f : problem.triangles)
    trace("f %lld %lld %lld\n", (long long)f[0], (long long)f[1], (long long)f[2]);
  for (const Point &p : problem.samples) trace("s %.17g %.17g %.17g\n", p[0], p[1], p[2]);
}

/// One for all inputs: it costs more than they do.
tetlod::Worker &worker() {
  static tetlod::Worker one(TETLOD_REMESH);
  return one;
}

bool remesh(Stage &stage, const Problem &problem) {
  tetlod::Surface surface(stage.memory());
  tetlod::Array<tetlod::Vec3> samples(&stage.memory());
  tetlod::RemeshResult result(stage.memory());
  trace_problem(problem);
  const tetlod::Vec3 untouched(7);
  const Status status =
      stage.call("remesh",
                 {Status::remesh, Status::mesh_empty, Status::mesh_index, Status::mesh_nonfinite,
                  Status::mesh_degenerate, Status::mesh_nonmanifold, Status::mesh_intersecting, Status::time_limit},
                 [&] {
                   fill(problem, surface);
                   for (const Point &p : problem.samples) samples.push_back({p[0], p[1], p[2]});
                   result.points.push_back(untouched);
                   tetlod::remesh(surface, samples, worker(), stage.job(), result, problem.points_at_once);
                 });
  stage.calm();
  if (status == Status::ok)
    check_success(problem, result);
  else
    DEMAND(result.points.size() <= 1 && result.tets.empty(), "a failure leaves the result as it was");
  if (problem.sound)
    DEMAND(status == Status::ok || status == Status::memory || status == Status::cancelled,
           "a sound surface is filled: %d", int(status));
  return status == Status::remesh;
}

}  // namespace

}  // namespace fuzz

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  fuzz::settle();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Bytes in(data, size);
  fuzz::Problem problem = fuzz::decode_problem(in);
  fuzz::Stage stage(in);
  if (in.one_in(2)) problem.points_at_once = 1 + in.below(64);
  if (fuzz::remesh(stage, problem)) fuzz::keep("remesh", data, size);
  return 0;
}
