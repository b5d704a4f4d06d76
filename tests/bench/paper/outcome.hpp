// What a method did with a mesh: measured, or why not.
#pragma once

#include <string>

#include "bench_mesh.hpp"
#include "field_error.hpp"
#include "mesh_shape.hpp"
#include "run_tetlod.hpp"
#include "topology.hpp"

namespace bench {

struct Original {
  std::string name;
  Mesh mesh;
  Shape shape;
  Topology topology;
};

Original original_of(const std::string &name, const std::string &path);

struct Outcome {
  bool done;
  char why_not[240];
  std::int64_t tets;
  double kept;    // part of the tets
  double cpu;     // seconds
  double volume;  // part of the original's
  FieldError error;
  bool valid, same_topology;
};

// In a process of its own, which may take so many CPU seconds: the peer does not come to an end on every mesh.
Outcome run_peer_within(const Original &original, std::int64_t tets, unsigned seconds);

// `run`, where it is not null, gets the whole run.
Outcome run_ours(const Original &original, const Parameters &parameters, TetlodRun *run = nullptr);

}  // namespace bench
