#include "interpolate.hpp"

#include "stencil.hpp"
#include "strided.hpp"
#include "transfer.hpp"

namespace tetlod {

void interpolate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points, std::int64_t leaf,
                 Job &job, Array<double> &values) {
  Stencil stencil(job.memory);
  find_stencils(mesh, boundary, points, leaf, job, stencil);
  values.resize(points.size());
  transfer(stencil, packed_reals(mesh.scalars.data(), mesh.scalars.size(), 1),
           packed_reals(values.data(), values.size(), 1), job);
}

}  // namespace tetlod
