// Cracks: faces inside a mesh whose two sides have points of their own at one place, with values of their own.
#pragma once
#include "submitted_mesh.hpp"

namespace tetlod {

struct Cracks {
  explicit Cracks(Memory &memory) : opened(&memory), asked(&memory) {}
  Moves opened;  ///< points of their sides, moved into their own, so that the sides lie apart
  Jumps asked;   ///< on which that depends
};

/// By which each side goes back from each of its faces, and at most from where it was; or the moves that were made
/// before, which are all.
struct Opening {
  double by, most;
  const Moves *made = nullptr;
};

/// Faces that tets have in common only by merging points, where the tets on both sides hang together by other faces,
/// with 63 others and more each: they stay two where, somewhere on those that hang together, a field that steers jumps
/// by more than a hundredth of its range. Others, as of a mesh that is bent to a ring, become one, and so do those
/// whose sides cannot lie apart, all if most points are at cracks, as of cells between which fields jump everywhere.
/// representative: as merge_points() or keep_touching_parts_apart() leaves it; of points at a crack, those of each side
/// become one of its own. Points that the host flags are not moved. Tets with an unused vertex are none.
Cracks keep_cracks_open(const SubmittedMesh &mesh, const Opening &opening, Job &job,
                        Array<std::int32_t> &representative);

}  // namespace tetlod
