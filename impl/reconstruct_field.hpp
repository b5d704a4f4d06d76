// 3.5  The remeshed boundary and samples get their values, and Steiner points those of the original field.
#pragma once
#include <cstdint>

#include "extract_boundary.hpp"
#include "remesh.hpp"

namespace tetlod {

/// What was remeshed.
struct Remeshed {
  Surface &surface;                  ///< its triangles are taken
  Span<const std::int32_t> samples;  ///< the original vertices that they are
  RemeshResult &result;              ///< taken
};

/// At most `leaf` tets go down the tree of the Steiner points together. origin: of each point, the original vertex that
/// it is, or -1.
void reconstruct_field(const MeshView &original, const Boundary &boundary, const Remeshed &remeshed, std::int64_t leaf,
                       Job &job, TetMesh &mesh, Array<std::int32_t> &origin);

}  // namespace tetlod
