// The size that was asked for, where no error asks for it.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// Where there are clearly fewer than `tets`: makes original vertices, with their own values, vertices of the mesh,
/// first where a tet has many of them, until there are so many, or no tet has one that leaves sound shapes. Of few tets
/// the last two, which are fewer than a vertex brings, are made of faces between others.
template <std::size_t m>
void fill_up(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
