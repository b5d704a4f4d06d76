// Past the paper: the remeshed result follows the field of the original, on the small mesh alone.
#pragma once
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

class TreeOnDemand;

struct RefineOptions {
  std::int64_t tets = 0;             ///< how many there shall be
  std::int64_t before_lowering = 0;  ///< how many of them, before the largest errors get the rest
  std::int64_t steiner = 0;          ///< how many of the points, the last ones, are Steiner points
  bool follows_field = true;         ///< vertices move and faces flip; else values are fitted alone
  int rounds = 0;                    ///< that also remove and insert vertices, after one pass that moves and flips
  double bound = 0;                  ///< of the error at every original vertex, absolute; 0: none
  Span<const std::uint8_t> kept;     ///< points that keep place and value, and the faces among them; empty: none
  TreeOnDemand *boundary = nullptr;  ///< of the original; must not be null
  double max_deviation = 0;          ///< of a new vertex of the boundary from the original's; 0: no limit
};

struct RefineReport {
  explicit RefineReport(Memory &memory) : beyond_bound(&memory) {}
  std::int64_t inserted = 0, inserted_on_boundary = 0;
  std::int64_t removed_samples = 0, removed_steiner = 0;
  Array<std::int32_t> beyond_bound;  ///< original vertices where the bound could not be held
  double max_error = 0;    ///< at the original vertices; those farther outside than by rounding with a bound alone
  double mean_square = 0;  ///< of the errors at the probes, in the scalars' unit
  double outside = 0;      ///< share of the original vertices, without a bound
  double deviation = 0;    ///< of the boundary from the original's, where vertices are new
};

/// `mesh` has points, scalars and tets. Fits its values, moves inner vertices, flips faces and edges, removes inner
/// vertices and inserts others, so that the field comes nearer to the original's; at last, where it is furthest off.
/// The surface stays where it is; the faces of it that get a vertex are divided. Points are numbered anew, those of the
/// boundary first, in their order; mesh.boundary is made.
RefineReport refine(const MeshView &original, const RefineOptions &options, Job &job, TetMesh &mesh);

}  // namespace tetlod
