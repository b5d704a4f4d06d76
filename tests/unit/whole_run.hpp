// A fixture: the whole run on generated meshes, with the real worker, and what the library promises of every result.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "brute_force.hpp"
#include "budget.hpp"
#include "measure_error.hpp"
#include "meshes.hpp"
#include "pipeline.hpp"
#include "prepared.hpp"
#include "status.hpp"

namespace tetlod::test {

inline double linear(const Vec3 &p) { return 5 + 2 * p.x - 3 * p.y + p.z; }
inline double waves(const Vec3 &p) { return std::sin(6 * p.x) * std::cos(5 * p.y) + p.z; }

/// In a context of its own.
inline void run(const Input &input, const Options &options, Worker &worker, Job &job, Result &result) {
  Prepared prepared(job.memory);
  run(input, options, worker, prepared, job, result);
}

inline FieldError measure_error(const Input &input, const Options &options, const Result &result, int samples_per_tet,
                                Job &job) {
  Prepared prepared(job.memory);
  return measure_error(input, options, result, samples_per_tet, prepared, job);
}

class WholeRun : public testing::Test {
 protected:
  Host host;
  Worker worker{TETLOD_REMESH};
  Result result{host.memory};
  Options options;

  void simplify(const Mesh &mesh) {
    result = Result(host.memory);
    run(input_of(mesh), options, worker, host.job, result);
  }

  Status status(const Mesh &mesh) {
    try {
      simplify(mesh);
      return Status::ok;
    } catch (const Error &error) {
      return error.status();
    }
  }

  const TetMesh &mesh() const { return result.mesh; }
  const Report &report() const { return result.report; }

  Mesh copy_of_result() const {
    return {{mesh().points.begin(), mesh().points.end()},
            {mesh().scalars.begin(), mesh().scalars.end()},
            {mesh().tets.begin(), mesh().tets.end()}};
  }

  /// What the library promises of every result.
  void expect_sound(const Mesh &original, double volume_error) {
    const auto at = [&](std::int32_t v) { return mesh().points[std::size_t(v)]; };
    std::vector<int> used(mesh().points.size(), 0);
    for (const Tet &t : mesh().tets) {
      ASSERT_GT(glm::dot(glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])), at(t[3]) - at(t[0])), 0);
      for (std::int32_t v : t) used[std::size_t(v)] = 1;
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "points that no tet uses";
    const Mesh copy = copy_of_result();
    const std::multiset<Triangle> faces = brute_boundary(copy);
    EXPECT_EQ(oriented_triangles(mesh().boundary), faces);
    const std::multiset<Triangle> original_faces = brute_boundary(original);
    const std::vector<Triangle> before(original_faces.begin(), original_faces.end());
    const SurfaceFacts was = facts_of({before.data(), before.size()}), is = facts_of(mesh().boundary);
    EXPECT_TRUE(is.closed);
    EXPECT_EQ(is.components, was.components);
    EXPECT_EQ(is.euler, was.euler);
    EXPECT_LE(is.nonmanifold_edges, was.nonmanifold_edges);
    const double most = report().remesh_attempts == 0 ? std::min(volume_error, 0.01) : volume_error;
    EXPECT_NEAR(volume_of(copy) / volume_of(original), 1, most);
    const auto [low, high] = std::minmax_element(original.scalars.begin(), original.scalars.end());
    for (double s : mesh().scalars) EXPECT_TRUE(s >= *low && s <= *high);
    expect_report(original, was);
  }

  void expect_report(const Mesh &original, const SurfaceFacts &was) const {
    const Report &r = report();
    EXPECT_EQ(r.points_in, std::int64_t(original.points.size()));
    EXPECT_EQ(r.tets_in, std::int64_t(original.tets.size()));
    EXPECT_EQ(r.boundary_points_in, was.vertices);
    EXPECT_EQ(r.boundary_edges_in, was.edges);
    EXPECT_EQ(r.boundary_triangles_in, was.triangles);
    EXPECT_EQ(r.nonmanifold_edges, was.nonmanifold_edges);
    EXPECT_EQ(r.interior_points_in + r.boundary_points_in + r.unused_points + r.merged_points + r.nonfinite_points,
              r.points_in);
    const SurfaceFacts is = facts_of(mesh().boundary);
    EXPECT_EQ(r.boundary_points_out, is.vertices);
    EXPECT_EQ(r.boundary_edges_out, is.edges);
    EXPECT_EQ(r.boundary_triangles_out, is.triangles);
    EXPECT_LE(r.samples, r.selected_samples - r.samples_outside - r.samples_too_near);
    EXPECT_EQ(r.points_out, r.boundary_points_out + r.samples + r.steiner_points + r.inserted_points);
    EXPECT_EQ(r.points_out, std::int64_t(mesh().points.size()));
    EXPECT_EQ(r.tets_out, std::int64_t(mesh().tets.size()));
    EXPECT_GE(r.remesh_attempts, options.clean_edges == 0 && !as_published(options) ? 0 : 1);
    const double stages = std::accumulate(r.seconds.begin(), r.seconds.end(), 0.0);
    EXPECT_LE(stages, r.seconds_total);
    EXPECT_GT(r.peak_bytes, 0u);
    EXPECT_EQ(r.worker_peak_bytes > 0, r.remesh_attempts > 0);
    EXPECT_EQ(r.scalar_min, *std::min_element(original.scalars.begin(), original.scalars.end()));
    EXPECT_EQ(r.scalar_max, *std::max_element(original.scalars.begin(), original.scalars.end()));
  }

  /// Samples are original vertices, with their values, bit for bit.
  void expect_samples(const Mesh &original) const {
    const std::size_t first = std::size_t(report().boundary_points_out);
    for (std::size_t i = first; i < first + std::size_t(report().samples); i++) {
      const auto found = std::find(original.points.begin(), original.points.end(), mesh().points[i]);
      ASSERT_NE(found, original.points.end());
      ASSERT_EQ(mesh().scalars[i], original.scalars[std::size_t(found - original.points.begin())]);
    }
  }
};

}  // namespace tetlod::test
