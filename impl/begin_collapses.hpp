// Where the collapses of a solid begin: at the original, at what is left after some rounds that a kept state has, or at
// what earlier values left.
#pragma once
#include "decimate_solid.hpp"
#include "solid_mesh.hpp"

namespace tetlod {

template <std::size_t m>
struct CollapseStart {
  SolidMesh<m> solid;
  SolidProgress progress;
  bool keeps_states;  ///< they are on the way from the original with these values
};

template <std::size_t m>
CollapseStart<m> begin_collapses(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                                 const SolidOptions &options, SolidHistory &history, Job &job);

}  // namespace tetlod
