// How values change from one step of a simulation to the next, in ways that are slow or fast, smooth or not.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench_mesh.hpp"

namespace bench {

struct Change {
  std::string name;
  // In a step, from 0 on, at a point whose distances from the low corner of the mesh's box are parts of its diagonal.
  // `first`: the value there before the first step, 0 to 1 over the mesh.
  std::function<double(const Point &point, double first, int step)> value;
};

// A wave on top of the mesh's own values, which grows by so large a part of their range in a step, of so many radians
// along a diagonal.
Change growing_wave(std::string name, double part, double along_x = 9, double along_y = 5);

// Waves, fronts that move, get smoother or sharper, fields that fade, are raised to powers, noise that vanishes.
std::vector<Change> all_changes();

// A mesh whose values take one step after another, in place: they may be lent meanwhile.
class ChangingMesh {
 public:
  ChangingMesh(Mesh mesh, Change change);
  void go_to(int step);
  const Mesh &mesh() const { return mesh_; }

 private:
  Mesh mesh_;
  Change change_;
  std::vector<Point> places_;
  std::vector<double> first_;
};

}  // namespace bench
