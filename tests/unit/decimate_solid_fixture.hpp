// What tests of the collapsing of a solid share.
#pragma once
#include <gtest/gtest.h>

#include <random>

#include "brute_force.hpp"
#include "decimate_solid_and_check.hpp"
#include "geometry.hpp"
#include "meshes.hpp"
#include "surface_distance.hpp"

namespace tetlod::test {

inline double waves(const Vec3 &p) { return std::sin(6 * p.x) * std::cos(5 * p.y) + p.z * p.z; }

/// Its rim is sharper than a fold may get.
inline Mesh flat_body() {
  Mesh flat = kuhn_cube(8);
  transform(flat, [](const Vec3 &p) {
    const Vec3 bent = p + 0.05 * Vec3(std::sin(9 * p.y), std::sin(8 * p.z), std::sin(7 * p.x));
    const Vec3 across = bent + 0.7 * Vec3(-bent.y, bent.x, 0);
    return Vec3(across.x - 0.6 * bent.z, across.y + 0.5 * bent.z, 0.002 * (bent.x + bent.y + bent.z));
  });
  return flat;
}

/// Inner vertices a little elsewhere.
inline void jitter(Mesh &mesh, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-most, most);
  transform(mesh, [&](const Vec3 &p) {
    const bool inner = std::min({p.x, p.y, p.z}) > 0 && std::max({p.x, p.y, p.z}) < 1;
    return inner ? p + Vec3(step(random), step(random), step(random)) : p;
  });
}

class DecimateSolid : public testing::Test {
 protected:
  Host host;
  Mesh original;
  Boundary boundary{host.memory};
  Surface surface{host.memory};
  SurfaceTopology topology{host.memory};
  TreeOnDemand tree;
  ContactsOnDemand contacts;
  SolidOptions options;
  std::int64_t lowered = 0;  ///< as decimate_solid_and_check has it
  std::string failure;       ///< of the last decimation

  void start_with(const Mesh &mesh) {
    original = mesh;
    boundary = Boundary(host.memory);
    surface = Surface(host.memory);
    topology = SurfaceTopology(host.memory);
    extract_boundary(original.view(), host.job, boundary);
    make_surface(original.view(), boundary.triangles, host.job, surface);
    find_topology(surface.points, surface.triangles, host.job, topology);
    tree = TreeOnDemand(surface);
    contacts = {};
  }

  bool decimate(double ratio, Host &on, CoarseSolid &coarse) {
    SolidHistory history(on.memory);
    return decimate(ratio, on, history, coarse);
  }

  bool decimate(double ratio, Host &on, SolidHistory &history, CoarseSolid &coarse) {
    options.tets = std::int64_t(ratio * double(original.tets.size()));
    const MeshView view = original.view();
    TreeOnDemand tree_there(surface);  // of memory of `on`
    ContactsOnDemand contacts_there;
    coarse = decimate_solid_and_check({view, boundary, surface, topology, tree_there, contacts_there}, options, lowered,
                                      history, on.job);
    failure = coarse.wrong;
    return failure.empty();
  }

  bool crosses_itself(const TetMesh &mesh) {
    Surface of_mesh(host.memory);
    of_mesh.points = mesh.points;
    of_mesh.triangles = mesh.boundary;
    return !crossings(of_mesh, host.memory).empty();
  }

  static void expect_same(const TetMesh &a, const TetMesh &b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.scalars, b.scalars);
    EXPECT_EQ(a.tets, b.tets);
  }

  void expect_sound(const CoarseSolid &coarse) const {
    Mesh mesh;
    mesh.points.assign(coarse.mesh.points.begin(), coarse.mesh.points.end());
    mesh.tets.assign(coarse.mesh.tets.begin(), coarse.mesh.tets.end());
    for (const Tet &t : mesh.tets) {
      const auto p = [&](int k) { return mesh.points[std::size_t(t[std::size_t(k)])]; };
      EXPECT_GT(det(p(0), p(1), p(2), p(3)), 0);
    }
    EXPECT_EQ(oriented_triangles(coarse.mesh.boundary), brute_boundary(mesh));
    const SurfaceFacts was = facts_of(boundary.triangles), is = facts_of(coarse.mesh.boundary);
    EXPECT_TRUE(is.closed);
    EXPECT_EQ(is.components, was.components);
    EXPECT_EQ(is.euler, was.euler);
    EXPECT_EQ(is.nonmanifold_edges, was.nonmanifold_edges);
    EXPECT_TRUE(crossings(coarse.surface, const_cast<Host &>(host).memory).empty());
    EXPECT_NEAR(volume_of(mesh) / volume_of(original), 1, 0.01);
  }
};

}  // namespace tetlod::test
