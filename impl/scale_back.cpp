#include "scale_back.hpp"

#include <cmath>

#include "geometry.hpp"
#include "status.hpp"
#include "tet_checks.hpp"

namespace tetlod {

void scale_back(const Original &original, Job &job, TetMesh &mesh) {
  const int exponent = original.exponent;
  if (exponent == 0) return;
  Array<Vec3> rounded(&job.memory);
  rounded.reserve(mesh.points.size());
  for (Vec3 &p : mesh.points) {
    p = times_power_of_two(p, exponent);
    rounded.push_back(times_power_of_two(p, -exponent));
  }
  std::string wrong = make_all_positive(rounded, {mesh.tets.data(), mesh.tets.size()}, 1, job);
  if (wrong.empty()) wrong = check_volume(rounded, mesh.tets, mesh.boundary, 1, job);
  if (!wrong.empty())
    fail(Status::mesh_degenerate, "doubles are too far apart for a mesh %g across: %s",
         std::ldexp(original.box.diagonal(), exponent), wrong.c_str());
}

}  // namespace tetlod
