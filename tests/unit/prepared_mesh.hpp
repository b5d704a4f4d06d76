// A fixture: a mesh as a run prepares it, with its boundary.
#pragma once
#include <gtest/gtest.h>

#include "meshes.hpp"
#include "prepare.hpp"

namespace tetlod::test {

class PreparedMesh : public testing::Test {
 protected:
  Host host{2};
  Options options;
  Original original{host.memory};
  Boundary boundary{host.memory};

  void prepare(const Mesh &mesh) {
    original = Original(host.memory);
    boundary = Boundary(host.memory);
    prepare_with_boundary(input_of(mesh), options, host.job, original, boundary);
  }
};

}  // namespace tetlod::test
