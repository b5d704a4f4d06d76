#include "remesh_attempts.hpp"

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "geometry.hpp"
#include "remesh_frame.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

/// p: the boundary is given. Y: it is kept. A: number the regions. M0/1: do not merge points. T1e-5: what counts as
/// flat; the default 1e-8 may start from a tet of rounding noise. J: keep unused points, so numbers stay. z: from 0. Q.
std::string switches(std::int64_t components, bool own_tolerance) {
  return std::string("pY") + (components > 1 ? "A" : "") + "M0/1" + (own_tolerance ? "T1e-5" : "") + "JzQ";
}

bool holds(const Box &box, const Vec3 &p) {
  return glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
}

/// Not one beyond the surface's box: no tet would use it, and far away ones make TetGen loop or fail.
void add_sample(const RemeshProblem &problem, std::size_t i, const Frame &frame, Array<Vec3> &points,
                Array<std::int32_t> &number) {
  if (!holds(problem.box, problem.samples[i])) return;
  points.push_back(frame.into(problem.samples[i]));
  number.push_back(std::int32_t(problem.surface.points.size() + i));
}

/// The boundary alone, in a frame.
RemeshInput boundary_input(const RemeshProblem &problem, const Frame &frame) {
  RemeshInput input(problem.job.memory);
  input.frame = frame;
  input.switches = switches(problem.components, true);
  input.triangles.assign(problem.surface.triangles.begin(), problem.surface.triangles.end());
  input.points.reserve(problem.surface.points.size() + problem.samples.size());
  input.number.reserve(problem.surface.points.size() + problem.samples.size());
  for (std::size_t i = 0; i < problem.surface.points.size(); i++) {
    input.points.push_back(frame.into(problem.surface.points[i]));
    input.number.push_back(std::int32_t(i));
  }
  return input;
}

RemeshInput framed_input(const RemeshProblem &problem, const Frame &frame) {
  RemeshInput input = boundary_input(problem, frame);
  for (std::size_t i = 0; i < problem.samples.size(); i++) add_sample(problem, i, frame, input.points, input.number);
  return input;
}

RemeshInput plain(const RemeshProblem &problem, double) { return framed_input(problem, uniform_frame(problem.box)); }

RemeshInput facets_reversed(const RemeshProblem &problem, double fraction) {
  RemeshInput input = plain(problem, fraction);
  std::reverse(input.triangles.begin(), input.triangles.end());
  return input;
}

/// Each axis by a power of two of its own: the metric changes in which TetGen calls a tet bad.
RemeshInput axes_stretched(const RemeshProblem &problem, double) {
  return framed_input(problem, stretched_frame(problem.box));
}

RemeshInput default_tolerance(const RemeshProblem &problem, double fraction) {
  RemeshInput input = plain(problem, fraction);
  input.switches = switches(problem.components, false);
  return input;
}

/// A permutation that is the same everywhere: std::shuffle is not.
Array<std::int32_t> shuffled(std::size_t count, Memory &memory) {
  Array<std::int32_t> order(count, &memory);
  for (std::size_t i = 0; i < count; i++) order[i] = std::int32_t(i);
  std::mt19937_64 random(1);
  for (std::size_t i = count; i > 1; i--) std::swap(order[i - 1], order[std::size_t(random() % i)]);
  return order;
}

RemeshInput vertices_shuffled(const RemeshProblem &problem, double fraction) {
  const RemeshInput input = plain(problem, fraction);
  RemeshInput mixed = boundary_input(problem, input.frame);
  const Array<std::int32_t> target = shuffled(input.points.size(), problem.job.memory);
  mixed.points.resize(input.points.size());
  mixed.number.resize(input.number.size());
  for (std::size_t i = 0; i < target.size(); i++) {
    mixed.points[std::size_t(target[i])] = input.points[i];
    mixed.number[std::size_t(target[i])] = input.number[i];
  }
  for (Triangle &t : mixed.triangles)
    for (std::int32_t &corner : t) corner = target[std::size_t(corner)];
  return mixed;
}

RemeshInput samples_inserted_late(const RemeshProblem &problem, double) {
  RemeshInput input = boundary_input(problem, uniform_frame(problem.box));
  for (std::size_t i = 0; i < problem.samples.size(); i++)
    add_sample(problem, i, input.frame, input.insert, input.insert_number);
  input.switches += "i";
  return input;
}

/// Nearer to the surface than half the longest edge of the nearest triangle.
bool crowds(const Vec3 &p, const Surface &surface, const TriangleTree &triangles) {
  const NearestPoint at = triangles.nearest(p);
  if (at.triangle < 0) return false;
  const Triangle &t = surface.triangles[std::size_t(at.triangle)];
  const Vec3 &a = surface.points[std::size_t(t[0])], &b = surface.points[std::size_t(t[1])],
             &c = surface.points[std::size_t(t[2])];
  return 4 * at.distance * at.distance < std::max({length2(b - a), length2(c - b), length2(a - c)});
}

RemeshInput without_crowding_samples(const RemeshProblem &problem, double fraction) {
  RemeshInput input = boundary_input(problem, uniform_frame(problem.box));
  const TriangleTree triangles(problem.surface.points, problem.surface.triangles, problem.job);
  for (std::size_t i = 0; i < problem.samples.size(); i++) {
    if (i % 256 == 0) problem.job.poll(fraction);
    if (!crowds(problem.samples[i], problem.surface, triangles))
      add_sample(problem, i, input.frame, input.points, input.number);
  }
  return input;
}

RemeshInput without_samples(const RemeshProblem &problem, double) {
  return boundary_input(problem, uniform_frame(problem.box));
}

/// The ladder. The first two retries rescued 14 of 14 failures of valid surfaces.
constexpr RemeshAttempt ladder[] = {
    {"plain", plain, false},
    {"facets reversed", facets_reversed, false},
    {"axes stretched", axes_stretched, false},
    {"default tolerance", default_tolerance, false},
    {"vertices shuffled", vertices_shuffled, false},
    {"samples inserted late", samples_inserted_late, true},
    {"without samples near the boundary", without_crowding_samples, true},
    {"without samples", without_samples, true},
};

}  // namespace

Span<const RemeshAttempt> remesh_attempts() { return {ladder, std::size(ladder)}; }

}  // namespace tetlod
