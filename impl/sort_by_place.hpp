// Tets in an order in which neighbours in space are mostly near each other in memory.
#pragma once
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Along Morton's curve through the tets' centroids.
void sort_by_place(Span<const Vec3> points, Array<Tet> &tets, Job &job);

}  // namespace tetlod
