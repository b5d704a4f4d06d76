// Which tet holds a point, against a look at all of them, in whatever order they are.
#include <gtest/gtest.h>

#include <random>

#include "adaptive_meshes.hpp"
#include "tet_locator.hpp"

namespace tetlod {
namespace {

using namespace test;

/// So many tets that several are one item of the tree, around a pit that walks end at.
class Located : public testing::Test {
 protected:
  static constexpr int n = 24;
  Located()
      : original(kuhn_solid({n, n, n}, [](const Cell &c) { return c[0] < 8 || c[0] > 14 || c[1] < 4; })),
        mesh(host.memory) {}

  /// Every so-manieth one comes after the others, anywhere.
  void scatter(std::size_t step) {
    std::vector<Tet> in_order, anywhere;
    for (std::size_t t = 0; t < original.tets.size(); t++)
      (t % step == 0 ? anywhere : in_order).push_back(original.tets[t]);
    std::shuffle(anywhere.begin(), anywhere.end(), std::mt19937(7));
    in_order.insert(in_order.end(), anywhere.begin(), anywhere.end());
    original.tets = in_order;
  }

  bool holds(std::int32_t t, const Vec3 &p) const {
    double w[4];
    mesh.frame(t).weights(p, w);
    return *std::min_element(w, w + 4) >= -1e-6;
  }

  bool any_holds(const Vec3 &p) const {
    for (std::size_t t = 0; t < mesh.tets.size(); t++)
      if (holds(std::int32_t(t), p)) return true;
    return false;
  }

  void expect_all_found(const TetLocator &locator) const {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.5, n + 0.5);
    std::int32_t hint = -1;
    for (int i = 0; i < 200; i++) {
      const Vec3 p(place(random), place(random), place(random));
      const std::int32_t t = locator.find(p, hint);
      if (t < 0) {
        EXPECT_FALSE(any_holds(p)) << i;
      } else {
        EXPECT_TRUE(holds(t, p)) << i;
        hint = t;
      }
    }
  }

  Host host{2};
  Mesh original;
  AdaptiveMesh<1> mesh;
};

TEST_F(Located, InOrder) {
  adapt(original, host, mesh);
  expect_all_found(TetLocator(mesh, host.job));
}

TEST_F(Located, WithSomeOfThemAnywhereNoSearchTakesLonger) {
  AdaptiveMesh<1> in_order(host.memory);
  adapt(original, host, in_order);
  scatter(20);
  adapt(original, host, mesh);
  const TetLocator locator(mesh, host.job);
  expect_all_found(locator);
  EXPECT_LT(locator.items_at_a_place(), 6 * TetLocator(in_order, host.job).items_at_a_place());
}

}  // namespace
}  // namespace tetlod
