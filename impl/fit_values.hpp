// The values at the vertices of a mesh that serve its probes best, by least squares.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// At most `steps` steps of conjugate gradients from the values as they are, on the sum of squared residuals at the
/// probes plus a small pull to those values, which decides where no probe does. Each value ends within the range of the
/// probes and vertices of its tets, so nothing overshoots. Errors of the tets are measured again.
template <std::size_t m>
void fit_values(int steps, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
