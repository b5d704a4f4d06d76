// Past the paper: a coarse mesh by collapsing edges of the original, inner ones and those of the boundary alike, where
// that loses least of the field [Garland and Zhou 2005]; in rounds, each of many collapses that are apart. Far from the
// size a vertex inside just moves into a neighbour, which is soon found and loses no more in the end; near it the
// vertex that is left comes to the best place.
#pragma once
#include "contacts.hpp"
#include "deviation.hpp"
#include "extract_boundary.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "solid_state.hpp"
#include "surface_topology.hpp"

namespace tetlod {

class TreeOnDemand;

/// What is decimated.
struct OriginalSolid {
  const MeshView &mesh;
  const Boundary &boundary;
  const Surface &surface;           ///< the boundary with points of its own
  const SurfaceTopology &topology;  ///< of that
  TreeOnDemand &tree;               ///< of that
  ContactsOnDemand &contacts;       ///< of that

  const Contacts &find_contacts(Job &job) const { return contacts.get(surface, topology, tree, job); }
};

struct SolidOptions {
  std::int64_t tets = 0;                    ///< how many there shall be
  std::int64_t enough = 0;                  ///< with fewer than so many it also ends where collapses get dear
  double dearest = 0;                       ///< what they may cost then, the square of a length
  double max_deviation = 0;                 ///< as in DecimateOptions
  Samples measured_at = Samples::vertices;  ///< what of the boundaries a deviation is told of
  bool hasty = false;             ///< vertices inside are removed nearer to the size, and more of them in a round
  bool holds_bound = false;       ///< what is flattest gets no flatter, as a bound is to be held there
  bool may_relax = false;         ///< where little is admissible else, the boundary may get more folded than it is,
  std::int64_t relaxed_from = 0;  ///< and with so many tets or fewer in any case
  double planes = 1;              ///< what the boundary's planes weigh, of weigh_planes()
  bool is_attempt = false;        ///< one of several: no states come and go
  double warm_start = 0;  ///< begins where earlier values left the solid, if the error gets larger by this part at most
  Span<const std::uint8_t> kept;      ///< original vertices that keep place and value; empty: none
  Span<const std::uint8_t> restored;  ///< others that do so this time; empty: none
  Span<const std::uint8_t> touching;  ///< original vertices where the solid touches itself; empty: none
  MayMeet may_meet;                   ///< original vertices of solids in contact, which care lets meet
  std::size_t later = 0;              ///< bytes in use when the run is further on, without the states that it keeps
  std::int64_t careful_from = 0;  ///< with so many tets or fewer no collapse takes the boundary through itself; from
                                  ///< all tets on no state begins it, and none is kept
  bool one_of_many = false;       ///< other sizes are likely to follow: states are worth some memory
};

/// mesh: what is left, as many tets as there shall be, a thousandth more at most, or more where no further collapse is
/// admissible, or cheap enough; points, values, tets and boundary, of the original's topology and, to 1 %, its volume.
/// origin: what each point was, see came_from.hpp. Tets that were flat may be left, and the boundary may
/// cross itself: to be looked at. history: of this mesh, begun with these values and this way, and with these flags; it
/// shortens the way to the same bytes, and gets more states, but with max_deviation; of earlier values, with a warm
/// start, it shortens the way to others; restored vertices it forgets all for. original.tree is dropped, and may be
/// made anew. Returns how many collapses it saved.
std::int64_t decimate_solid(const OriginalSolid &original, const SolidOptions &options, SolidHistory &history, Job &job,
                            TetMesh &mesh, Array<std::int32_t> &origin);

}  // namespace tetlod
