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

/// Of each point the original vertex that it is; -1 where decimation or TetGen placed it.
Array<std::int32_t> original_vertices(const Remeshed &remeshed, Memory &memory);

/// At most `leaf` tets go down the tree of the Steiner points together. origin: the original_vertices.
void reconstruct_field(const MeshView &original, const Boundary &boundary, const Remeshed &remeshed, std::int64_t leaf,
                       Job &job, TetMesh &mesh, Array<std::int32_t> &origin);

}  // namespace tetlod
