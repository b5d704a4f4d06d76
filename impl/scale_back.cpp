#include "scale_back.hpp"

#include <cmath>
#include <limits>

#include "geometry.hpp"
#include "status.hpp"
#include "tet_checks.hpp"

namespace tetlod {

namespace {

/// By no more than doubles of the mesh's size are anyhow. Not where it has become infinite.
bool is_near(const Vec3 &rounded, const Vec3 &p) {
  const Vec3 off = glm::abs(rounded - p);
  return off.x <= std::numeric_limits<double>::epsilon() && off.y <= std::numeric_limits<double>::epsilon() &&
         off.z <= std::numeric_limits<double>::epsilon();
}

}  // namespace

void scale_back(const Original &original, Job &job, TetMesh &mesh) {
  const int exponent = original.exponent;
  if (exponent == 0) return;
  Array<Vec3> rounded(&job.memory);
  rounded.reserve(mesh.points.size());
  std::string wrong;
  for (Vec3 &p : mesh.points) {
    const Vec3 scaled = p;  // the largest coordinate of the original is between one and two
    p = times_power_of_two(scaled, exponent);
    rounded.push_back(times_power_of_two(p, -exponent));
    if (!is_near(rounded.back(), scaled)) wrong = "points would be rounded far away";
  }
  if (wrong.empty()) wrong = make_all_positive(rounded, {mesh.tets.data(), mesh.tets.size()}, 1, job);
  if (!wrong.empty())
    fail(Status::mesh_degenerate, "doubles cannot hold what is left of a mesh %s across: %s",
         number(std::ldexp(original.box.diagonal(), exponent)).c_str(), wrong.c_str());
}

}  // namespace tetlod
