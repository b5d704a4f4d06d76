// Small meshes as refine() has them, for the tests of its steps.
#pragma once
#include "adaptive_mesh.hpp"
#include "meshes.hpp"

namespace tetlod::test {

/// One tet, which has the values of `field` at its corners.
inline Mesh corner_tet(const Field &field) {
  Mesh mesh{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {}, {{0, 1, 2, 3}}};
  set_scalars(mesh, field);
  return mesh;
}

/// Without probes.
inline void adapt(const Mesh &from, Host &host, AdaptiveMesh<1> &mesh) {
  const TetMesh upright = as_result(from, host.memory);
  mesh.points.assign(upright.points.begin(), upright.points.end());
  mesh.tets.assign(upright.tets.begin(), upright.tets.end());
  for (double value : from.scalars) mesh.values.push_back({value});
  mesh.kept.assign(mesh.points.size(), 0);
  mesh.connect(host.job);
}

/// In the only tet.
inline void add_probe(const Vec3 &place, double value, AdaptiveMesh<1> &mesh) {
  mesh.probes.push_back({place, {value}});
  mesh.next_probe.push_back(-1);
  mesh.put_probe(std::int32_t(mesh.probes.size()) - 1, 0);
  mesh.measure(0);
}

}  // namespace tetlod::test
