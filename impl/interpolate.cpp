#include "interpolate.hpp"

#include "stencil.hpp"
#include "strided.hpp"
#include "transfer.hpp"

namespace tetlod {

void interpolate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points, std::int64_t leaf,
                 Job &job, Array<double> &values) {
  Stencil stencil(job.memory);
  find_stencils(mesh, boundary, points, {}, leaf, job, stencil);
  const auto fields = int(mesh.fields);
  values.resize(points.size() * mesh.fields);
  transfer(stencil, packed_array(mesh.scalars.data(), mesh.points.size(), fields),
           packed_array(values.data(), points.size(), fields), job);
}

}  // namespace tetlod
