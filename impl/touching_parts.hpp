// Parts of a mesh that have points of their own where they touch, as those of an assembly.
#pragma once
#include "submitted_mesh.hpp"

namespace tetlod {

struct KeptApart {
  explicit KeptApart(Memory &memory) : torn(&memory), asked(&memory) {}
  Torn torn;    ///< that have faces in common all the same
  Jumps asked;  ///< on which that depends
};

/// Where parts have a face in common the mesh goes on from the one to the other, unless both have 64 tets, and a field
/// that steers jumps between them somewhere, by more than a hundredth of its range, or they lie on one another beside
/// that face in other ways; if any have, also where it conforms only after make_conforming(). Where they only touch, at
/// a vertex, an edge or where faces lie on one another in other ways, it does not, and points of several parts at one
/// place would make slits and edges of four triangles of it. representative: as merge_points() leaves it; of points at
/// one place, each part's become one of its own. Parts: tets that have points in common, as submitted, or a face by
/// place. Tets with an unused vertex are none.
KeptApart keep_touching_parts_apart(const SubmittedMesh &mesh, Job &job, Array<std::int32_t> &representative);

}  // namespace tetlod
