// Cracks that a field jumps across: a run keeps the values of both sides, or has them be one.
#include <set>

#include "carry_fields.hpp"
#include "validate.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class CrackedRuns : public WholeRun {
 protected:
  static constexpr int cells = 12;

  /// How far the values of the result are apart, in the middle of the crack.
  double jump_of_result() const {
    double low = 1e9, high = -1e9;
    for (std::size_t v = 0; v < mesh().points.size(); v++) {
      if (glm::distance(mesh().points[v], Vec3(0.5)) > 0.1) continue;
      low = std::min(low, mesh().scalars[v]);
      high = std::max(high, mesh().scalars[v]);
    }
    return high - low;
  }

  Result run_later(const Mesh &original, Prepared &prepared) {
    Result later(host.memory);
    run(input_of(original), options, worker, prepared, host.job, later);
    return later;
  }
};

TEST_F(CrackedRuns, KeepTheValuesOfBothSides) {
  const Mesh original = cracked_cube(cells, 1);
  for (const auto &[ratio, bound] : {std::pair(0.3, 0.0), {0.1, 0.0}, {0.0, 0.03}, {0.0, 0.01}})
    for (const std::int64_t effort : {effort_fast, effort_accurate}) {
      options.target_ratio = ratio;
      options.max_error = bound;
      options.effort = effort;
      simplify(original);
      expect_sound(original, 0.01);
      EXPECT_LE(report().max_error, bound > 0 ? bound : 0.05);
      EXPECT_GT(jump_of_result(), 0.7);
      EXPECT_GE(report().max_deviation, 2e-7) << "by which the sides were moved";
      EXPECT_LE(report().max_deviation, 0.01);
    }
}

/// As a run of its own would do it: while no field jumps the sides are one. The mesh is looked at anew where that
/// changes.
TEST_F(CrackedRuns, ALaterStepHasItsOwn) {
  Prepared prepared(host.memory);
  options.target_ratio = 0.2;
  double before = -1;
  for (const double jump : {0.0, 1.0, 0.5, 0.0, 0.0001}) {
    const Mesh step = cracked_cube(cells, jump);
    const Result later = run_later(step, prepared);
    simplify(step);
    EXPECT_EQ(later.report.hash, report().hash) << jump;
    EXPECT_EQ(later.report.components, jump > 0.01 ? 2 : 1) << jump;
    EXPECT_EQ(later.report.reused_tets > 0, before >= 0 && (before > 0.01) == (jump > 0.01)) << jump;
    before = jump;
  }
}

/// Sides that are cut in different ways reach into each other where they are bent.
TEST_F(CrackedRuns, SidesThatWouldCrossAreOne) {
  const Mesh original = cracked_where_quads_cross(8, 1);
  for (const double bend : {0.0, 0.02}) {
    Mesh bent = original;
    transform(bent, [&](const Vec3 &p) { return Vec3(p.x, p.y, p.z + bend * p.x * p.y); });
    for (const double ratio : {0.5, 0.2}) {
      options.target_ratio = ratio;
      simplify(bent);
      EXPECT_EQ(report().components, bend > 0 ? 1 : 2);
      EXPECT_EQ(report().merged_points > 0, bend > 0);
      const SurfaceFacts is = facts_of(mesh().boundary);
      EXPECT_TRUE(is.closed);
      EXPECT_EQ(is.nonmanifold_edges, 0);
      EXPECT_EQ(is.components, bend > 0 ? 1 : 2);
    }
    EXPECT_EQ(verdict_on(input_of(bent), options, find_defects(input_of(bent), options, host.job), host.job).status(),
              Status::ok);
  }
}

/// Of such sides, too, the place of the flagged one counts, of which the other is a rounding away.
TEST_F(CrackedRuns, SidesThatWouldCrossKeepFlaggedPlaces) {
  Mesh bent = cracked_where_quads_cross(8, 1);
  transform(bent, [](const Vec3 &p) { return Vec3(p.x, p.y, p.z + 0.02 * p.x * p.y); });
  const auto numbers = [](const Vec3 &p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  std::set<std::array<double, 3>> seen, places;
  std::vector<std::uint8_t> flags(bent.points.size(), 0);
  std::set<std::int32_t> used;
  for (const Tet &t : bent.tets) used.insert(t.begin(), t.end());
  for (const std::int32_t v : used) {
    Vec3 &p = bent.points[std::size_t(v)];
    if (seen.insert(numbers(p)).second) continue;
    p.x = std::nextafter(p.x, 2);
    flags[std::size_t(v)] = keep_vertex;
    places.insert(numbers(p));
  }
  ASSERT_GT(places.size(), 10u);
  Input input = input_of(bent);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  options.target_ratio = 0.5;
  run(input, options, worker, host.job, result);
  EXPECT_EQ(report().merged_points, std::int64_t(places.size()));
  for (const Vec3 &p : mesh().points) places.erase(numbers(p));
  EXPECT_TRUE(places.empty()) << places.size();
}

TEST_F(CrackedRuns, AStencilIsThatOfTheRun) {
  const Mesh original = cracked_cube(cells, 1), without = cracked_cube(cells, 0);
  options.target_ratio = 0.3;
  Input with_field = input_of(original);
  with_field.fields.push_back({"field", Association::point, with_field.scalars});
  run(with_field, options, worker, host.job, result);
  const Stencil stencil = std::move(result.stencil);
  for (const bool is_prepared : {false, true}) {
    Prepared prepared(host.memory);
    if (is_prepared) estimate_memory(input_of(original), options, prepared, host.job);
    result.stencil = Stencil(host.memory);
    find_stencil(input_of(original), options, prepared, host.job, result);
    EXPECT_EQ(result.stencil.ids, stencil.ids);
    EXPECT_EQ(result.stencil.weights, stencil.weights);
    result.stencil = Stencil(host.memory);
    EXPECT_THROW(find_stencil(input_of(without), options, prepared, host.job, result), Error);
  }
}

/// Which sides are moved depends on flags, and a stencil is of what the run did.
TEST_F(CrackedRuns, AStencilIsThatOfTheRunWithFlags) {
  const Mesh original = cracked_cube(cells, 1);
  options.target_ratio = 0.3;
  for (const bool both : {false, true}) {
    std::vector<std::uint8_t> flags(original.points.size(), 0), others = flags;
    for (std::size_t v = 0; v < flags.size(); v++)
      flags[v] = original.points[v].z == 0.5 && (both || original.scalars[v] > 0.2) ? keep_vertex : 0;
    Input input = input_of(original);
    input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
    Input with_field = input;
    with_field.fields.push_back({"field", Association::point, input.scalars});
    result = Result(host.memory);
    run(with_field, options, worker, host.job, result);
    EXPECT_EQ(report().merged_points > 0, both);
    const Stencil stencil = std::move(result.stencil);
    for (const std::vector<std::uint8_t> &later : {flags, others}) {
      input.flags = strided(later.data(), later.size(), 1, 1, ElementType::uint8);
      Prepared prepared(host.memory);
      result.stencil = Stencil(host.memory);
      find_stencil(input, options, prepared, host.job, result);
      EXPECT_EQ(result.stencil.ids, stencil.ids);
      EXPECT_EQ(result.stencil.weights, stencil.weights);
    }
  }
}

/// Whether they can be open is not known before; a value that is none is no jump.
TEST_F(CrackedRuns, TheirPointsCountAsCoincident) {
  options.target_ratio = 0.3;
  for (const double jump : {0.0, 1.0})
    for (const bool is_finite : {true, false}) {
      Mesh original = cracked_cube(cells, jump);
      options.on_nonfinite = is_finite ? policy_error : policy_repair;
      if (!is_finite)
        *std::find(original.scalars.begin(), original.scalars.end(), original.scalars.back()) =
            std::numeric_limits<double>::infinity();
      options.on_coincident = policy_repair;
      const Input input = input_of(original);
      EXPECT_GT(find_defects(input, options, host.job).coincident.count, 8);
      EXPECT_EQ(status(original), Status::ok);
      options.on_coincident = policy_error;
      EXPECT_EQ(status(original), Status::mesh_degenerate);
    }
}

TEST_F(CrackedRuns, ADeviationOfNextToNothingIsHeld) {
  Prepared prepared(host.memory);
  options.target_ratio = 0.9;
  const Mesh original = cracked_cube(cells, 1);
  for (const double limit : {1e-3, 1e-7, 1e-3}) {
    options.max_deviation = limit;
    const Result later = run_later(original, prepared);
    EXPECT_LE(later.report.max_deviation, limit);
    EXPECT_EQ(later.report.merged_points > 0, limit == 1e-7);
    simplify(original);
    EXPECT_EQ(later.report.hash, report().hash);
  }
}

}  // namespace
}  // namespace tetlod
