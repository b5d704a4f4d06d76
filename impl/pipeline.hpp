// The run, stage by stage, in the paper's order [3.6].
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fingerprint.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "remesh.hpp"
#include "stencil.hpp"
#include "strided.hpp"
#include "worker.hpp"

namespace tetlod {

class Prepared;

/// What happens to a defect of the input that can be repaired. The numbers are those of the C ABI.
constexpr std::int64_t policy_error = 0, policy_repair = 1;

/// How much is done for accuracy when a size is asked for: a boundary that sees the field, samples where a linear field
/// would be wrong, fitted values; and connectivity that follows the field. The numbers are those of the C ABI.
constexpr std::int64_t effort_fast = 1, effort_accurate = 2;

struct Options {
  double target_ratio = 0;   ///< tets kept, of the original's; 0: the paper's method, sized by rho and sigma
  bool usual_ratio = false;  ///< that is a preset's: of no meaning beside a bound of the error
  std::int64_t effort = effort_accurate;  ///< of a run with a target
  std::int64_t remesh = 1;                ///< 0: tetlod-remesh is never started, edges collapse whatever the size
  double max_error = 0;                   ///< bound of the error at the original vertices, over the range; 0: none
  double max_deviation = 0;               ///< of the boundary, over the diagonal; 0: no limit
  double warm_start = 0;                  ///< how much larger the error may get where collapses take over earlier ones
  double rho = 0.01;
  double sigma = 0.1;
  double lambda = 0.1;
  double min_distance = 0.01;
  double merge_tolerance = 0;
  double clean_edges = 0;
  std::int64_t boundary_leaf = 200;
  std::int64_t tet_leaf = 500;
  std::int64_t threads = 1;
  std::int64_t seed = 1;
  double time_limit = 0;
  std::int64_t on_coincident = policy_repair;  ///< merge the points
  std::int64_t on_repeated = policy_repair;    ///< drop the tets
  std::int64_t on_flat = policy_repair;        ///< peel the tets off the boundary, keep them inside
  std::int64_t on_inverted = policy_repair;    ///< take the tets the other way round
  std::int64_t on_duplicate = policy_repair;   ///< drop the later tets
  std::int64_t on_overlap = policy_repair;     ///< move points, divide faces, keep contacts
  std::int64_t on_unused = policy_repair;      ///< ignore the points
  std::int64_t on_nonfinite = policy_error;  ///< repair: ignore points without a finite value together with their tets

  /// 0: a bound alone decides, or rho and sigma.
  double asked_ratio() const { return usual_ratio && max_error > 0 ? 0 : target_ratio; }
};

/// What a point's flags ask for: the vertex survives, with its place and value; edges and triangles of the boundary
/// between such vertices stay, too. The numbers are those of the C ABI.
constexpr std::uint8_t keep_vertex = 1, lock_vertex = 2;

/// The numbers are those of the C ABI.
enum class Association : std::int32_t { point = 0, cell = 1 };

/// A field that rides along: of any type and number of components.
struct SubmittedField {
  std::string name;
  Association association = Association::point;
  StridedArray values;
};

/// A further field that steers, beside the scalars.
struct SteeringField {
  std::string name;
  double weight = 1;  ///< positive: what its errors count, over its range, beside the scalars' over theirs
  StridedArray values;
};

/// The caller's arrays: shapes, types and strides are sound, contents are not looked at yet.
struct Input {
  std::array<StridedArray, 3> xyz;  ///< one component each
  StridedArray tets;                ///< four components
  std::int32_t index_base = 0;
  StridedArray scalars;                 ///< one component
  std::string scalars_name;             ///< or empty
  StridedArray flags;                   ///< of points: uint8, one component, keep_vertex or lock_vertex; absent: none
  std::vector<SubmittedField> fields;   ///< names are unique; as many tuples as points or tets
  std::vector<SteeringField> steering;  ///< less than most_fields; names are none of those

  std::size_t steering_fields() const { return 1 + steering.size(); }  ///< with the scalars
  const std::string &name_of_steering(std::size_t k) const { return k == 0 ? scalars_name : steering[k - 1].name; }
};

/// The rows of the paper's Table 2. Seconds by Stage.
struct Report {
  std::int64_t sound_tets() const { return tets_in - dropped_tets; }
  std::int64_t points_in = 0, tets_in = 0;
  std::int64_t merged_points = 0, nonfinite_points = 0, dropped_tets = 0, divided_tets = 0, unused_points = 0;
  std::int64_t moved_points = 0;
  std::int64_t interior_points_in = 0;
  std::int64_t boundary_points_in = 0, boundary_edges_in = 0, boundary_triangles_in = 0;
  std::int64_t components = 0, nonmanifold_edges = 0, nonmanifold_points = 0;
  std::int64_t cleaned_edges = 0;
  std::int64_t boundary_points_out = 0, boundary_edges_out = 0, boundary_triangles_out = 0;
  std::int64_t selected_samples = 0, samples_outside = 0, samples_too_near = 0, samples = 0;
  std::int64_t steiner_points = 0, inserted_points = 0, points_out = 0, tets_out = 0;
  std::int64_t remesh_attempts = 0, boundary_retries = 0;
  std::array<double, std::size_t(Stage::count)> seconds{};
  double seconds_total = 0;
  std::uint64_t peak_bytes = 0, worker_peak_bytes = 0, hash = 0;
  double scalar_min = 0, scalar_max = 0;
  double least_change = 1;   ///< least_change() of the original, of a run with a target
  bool keeps_some = false;   ///< the host flagged vertices
  double max_deviation = 0;  ///< between the boundaries, over the diagonal, at samples_for() the limit
  double max_error = 0;      ///< of a run with a target: at the original vertices, over the range, of any field
  /// Taken over from earlier work: tets_in or 0, boundary_triangles_out or 0, samples whose place was known, and
  /// collapses of edges of the solid.
  std::int64_t reused_tets = 0, reused_triangles = 0, reused_samples = 0, reused_collapses = 0;
};

/// A field of the result: a tuple a point or a tet.
struct CarriedField {
  CarriedField(const std::string &of, Association of_what, ElementType type_of, int components_of, Memory &memory)
      : name(of), association(of_what), type(type_of), components(components_of), values(&memory), integers(&memory) {}
  std::string name;
  Association association;
  ElementType type;  ///< as submitted
  int components;
  Array<double> values;          ///< of reals
  Array<std::int64_t> integers;  ///< of the others
};

/// Vertices that are elsewhere than where they were submitted, ascending.
struct Move {
  std::int32_t vertex;
  Vec3 to;
  bool operator==(const Move &other) const { return vertex == other.vertex && to == other.to; }
};
using Moves = Array<Move>;

/// One of several points that became the vertex, which the host flags.
struct FlaggedPoint {
  std::int32_t vertex, point;
  bool operator==(const FlaggedPoint &other) const { return vertex == other.vertex && point == other.point; }
  bool operator<(const FlaggedPoint &other) const {
    return vertex != other.vertex ? vertex < other.vertex : point < other.point;
  }
};

/// One step after another.
struct PointMoves {
  explicit PointMoves(Memory &memory) : flagged(&memory), opened(&memory), upright(&memory) {}
  Array<FlaggedPoint> flagged;  ///< ascending: the place of each vertex's first one counts, and its values
  Moves opened;                 ///< points of cracks that a field jumps across: their sides lie apart
  Moves upright;                ///< where tets were turned over: find_moves()
  bool operator==(const PointMoves &o) const {
    return flagged == o.flagged && opened == o.opened && upright == o.upright;
  }
};

/// Pairs of parts of a mesh as submitted, each known by the lowest of its points, ascending.
using Torn = Array<std::pair<std::int32_t, std::int32_t>>;

/// Two points at one place, and whether a field that steers jumps between them.
struct MayJump {
  std::int32_t one, other;
  bool jumps;
};
using Jumps = Array<MayJump>;

struct Result {
  explicit Result(Memory &memory) : mesh(memory), stencil(memory), torn(&memory), moves(memory) {}
  TetMesh mesh;
  Stencil stencil;                   ///< of the mesh's points, numbered as the caller's; empty until a field needs it
  std::vector<CarriedField> fields;  ///< and those that steered beside the scalars
  Report report;
  Fingerprint original;  ///< of its points and tets
  Torn torn;             ///< parts of it that stayed apart, though they have faces in common
  PointMoves moves;      ///< of it
};

/// Simplifies; throws Error. `result` is meant to be a fresh one: after a throw its contents mean nothing. Takes what
/// `prepared` has of earlier runs, and leaves there what later ones may use; after a throw it is to be forgotten.
void run(const Input &input, const Options &options, Worker &worker, Prepared &prepared, Job &job, Result &result);

/// What Report::peak_bytes of such a run would be, within a factor of 1.5 for sound meshes. Does the run's first
/// stages, the cheap ones, and knows of the others what they take; `prepared` then has them for the run.
std::uint64_t estimate_memory(const Input &input, const Options &options, Prepared &prepared, Job &job);

}  // namespace tetlod
