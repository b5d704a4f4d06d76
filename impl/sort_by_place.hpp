// Orders in which neighbours in space are mostly near each other in memory.
#pragma once
#include <functional>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// The numbers of the places, along Morton's curve through them.
Array<std::int32_t> order_by_place(std::size_t count, const std::function<Vec3(std::size_t)> &place, Job &job);

/// As they are, where those side by side in memory are so in space on the average, else along that curve.
Array<std::int32_t> order_in_space(std::size_t count, const std::function<Vec3(std::size_t)> &place, Job &job);

/// Tets along the curve through their centroids.
void sort_by_place(Span<const Vec3> points, Array<Tet> &tets, Job &job);

}  // namespace tetlod
