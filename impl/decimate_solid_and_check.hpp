// A coarse mesh by collapsing edges, where the outcome stands every test; else the caller has to remesh.
#pragma once
#include <string>

#include "decimate_solid.hpp"

namespace tetlod {

/// Of the diagonal: for any use a boundary that is so far off stands out, or lacks a tip.
constexpr double far_off = 0.02;
/// Times the tets, for a boundary that is nearer: of a size no more than the largest errors would get at least.
constexpr double hardly_more = 1.03;

struct CoarseSolid {
  explicit CoarseSolid(Memory &memory) : mesh(memory), origin(&memory), surface(memory), topology(memory) {}
  TetMesh mesh;
  Array<std::int32_t> origin;     ///< what each point was, see came_from.hpp
  Surface surface;                ///< the boundary with points of its own
  SurfaceTopology topology;       ///< of that
  std::int64_t reused = 0;        ///< collapses that decimate_solid's history saved
  std::string wrong;              ///< with it; empty: nothing
  bool is_sound = false;          ///< it has but the wrong size, if anything is wrong
  bool in_contact = false;        ///< solids are, as in the original, and may have moved into each other
  bool wants_care = false;        ///< its boundary is wrong, which care may avoid
  std::int64_t careful_from = 0;  ///< the care that it took, as in SolidOptions; others are likely to need it, too
  double deviation = 0;           ///< between the boundaries, at SolidOptions::measured_at
};

/// decimate_solid, with care where the boundary else comes to cross itself, which it seldom does: looking for that in
/// every collapse takes longer. Then move_outward and lower_deviation to so many tets at most, or, with lowered = 0 and
/// no limit to the deviation, the second alone, with no more and of what is far off, where that leaves the mesh sound;
/// if it does not, with moves that are guarded against crossings. options.touching is found here. The sound outcome of
/// fewest tets, else the last; of a given size, where the boundary is more than twice far_off away and collapses were
/// not stuck far from it, or could relax, one within that with hardly more tets, if there is one. What may be wrong: a
/// tet is not positive, tets overlap, the boundary crosses itself, but where solids are in contact, or has another
/// topology, solids are nested, or the size is missed by more than 1 %.
CoarseSolid decimate_solid_and_check(const OriginalSolid &original, SolidOptions options, std::int64_t lowered,
                                     SolidHistory &history, Job &job);

/// A sound one, with fewer tets than another sound one.
bool is_better(const CoarseSolid &a, const CoarseSolid &b);

}  // namespace tetlod
