// What a mesh is, found out again by brute force: its defects, its boundary, the topology of that. Slow, and shares
// nothing with the library but the exact sign of a determinant.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "meshes.hpp"

namespace fuzz {

using Face = std::array<std::int64_t, 3>;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Counts of defects, named as in tetlod_mesh_report.
struct Facts {
  std::int64_t index = 0, repeated = 0, nonfinite_points = 0, nonfinite_values = 0, coincident = 0, flat = 0;
  std::int64_t inverted = 0, duplicate = 0, nonmanifold_faces = 0, unused = 0;

  // After the repairs that are the default; empty where nothing can be repaired.
  std::vector<Corners> tets;   ///< merged, without those that are dropped, given twice, or peeled off as flat
  std::vector<Face> boundary;  ///< outward, in the numbers of the mesh
  Interval values;             ///< of the points that tets have which are not dropped
  Interval values_used;        ///< of all that tets have
  /// The sizes of coordinates differ by more than 1e90: products of three leave the range of doubles, and what is flat
  /// cannot be told. Or points differ by no more than rounding, for which they are at one place.
  bool wide = false;
  /// Vertices lie on edges, also of other parts, or faces lie on one another: tets are divided there, others take
  /// their place, parts are joined, where that is repaired; or parts may be large enough to stay apart where a field
  /// jumps. What comes of it is not found out again.
  bool gaps = false;
};

/// What a run does with a mesh.
struct Repairs {
  bool drop_nonfinite = true;   ///< points without a finite value go with their tets
  bool takes_contacts = false;  ///< points of parts that share no face do not merge
  bool closes_gaps = false;     ///< between faces that lie on one another and are not the same
};

/// Points merge only where they are equal.
Facts facts_of(const Mesh &mesh, const Repairs &repairs);

/// Of the surface as it is, not cut where it touches itself.
struct Topology {
  std::int64_t points = 0, edges = 0, triangles = 0;
  std::int64_t components = 0;  ///< connected through vertices
  bool closed = true;           ///< along each edge as many triangles run one way as the other
  std::int64_t euler() const { return points - edges + triangles; }
};
Topology topology_of(const std::vector<Face> &faces);

/// -1, 0, 1; exact, at any scale.
int side(const Point &a, const Point &b, const Point &c, const Point &d);

}  // namespace fuzz
