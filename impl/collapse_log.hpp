// The collapses of a decimation, so that it can be done again: as far, less far, or with other values.
#pragma once
#include <cmath>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

/// Vertices are those of the cut surface (SurfaceTopology).
struct Collapse {
  std::int32_t from, to;  ///< `from` becomes `to`
  bool moves;             ///< `to` gets the point and the values
  Vec3 point;
};

struct CollapseLog {
  explicit CollapseLog(Memory &memory) : collapses(&memory), scalars(&memory) {}
  Array<Collapse> collapses;
  Array<double> scalars;     ///< that each collapse gives, a value for each field
  std::int64_t cleaned = 0;  ///< how many of them, the first, removed short edges
  bool exhausted = false;    ///< no further collapse was admissible
};

/// Of so many edges, what sigma asks for.
inline std::int64_t edges_kept(double sigma, std::int64_t edges) {
  return std::int64_t(std::ceil(sigma * double(edges)));
}

/// How many of the log's collapses a decimation of its surface to sigma takes; -1: more than it has.
std::int64_t collapses_to(double sigma, std::int64_t edges, const CollapseLog &log);

/// Which values the vertices get that a collapse moves.
enum class MovedValues {
  logged,
  along_edges
};  ///< as logged, or what the paper's cost gives, from the surface's values

/// Does the first `count` collapses to the surface that they were logged of: the same bytes.
void replay(const CollapseLog &log, std::size_t count, const SurfaceTopology &topology, MovedValues values, Job &job,
            Surface &surface);

/// What decimation has: vertices of the cut surface, of which id tells what point of the surface each is.
struct CutVertices {
  Span<const Vec3> points;
  Span<const double> scalars;  ///< of each, one of each field
  Span<const std::int32_t> origin, id;
};

/// Welds the cut: out.triangles name cut vertices, and get points of their own, numbered by first use.
void weld(const CutVertices &vertices, std::size_t surface_points, Job &job, Surface &out);

}  // namespace tetlod
