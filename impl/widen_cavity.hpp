// A collapse whose tets would turn over: those beyond give way, too [Loseille and Menier 2013].
#pragma once
#include "solid_blocks.hpp"

namespace tetlod {

/// Of the tets around an edge and those beyond: grows across faces that the vertex that is left, at `place`, does not
/// see from inside, until it sees all; then edge.fresh are the cones over them. False, where the boundary or another
/// block is in the way, a vertex would be lost, hardly a tet saved, or too many changed. What a surface without
/// crossings holds, and is positive, covers each place once, as in flattens().
bool widen_cavity(const SolidComplex &mesh, const SolidBlocks &blocks, const Vec3 &place, SolidEdge &edge);

}  // namespace tetlod
