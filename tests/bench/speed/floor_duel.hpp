// Whole runs against what they cannot go under: TetGen alone, and the memory.
#pragma once

#include "bench_mesh.hpp"
#include "duel.hpp"
#include "run_tetlod.hpp"

namespace bench {

// Against bare TetGen with the boundary and the vertices of the result: a speed of one half means that everything
// else costs as much as TetGen. And against one pass that reads the tets and writes each of their faces, the hardware's
// floor for a boundary extraction, with as many threads.
std::vector<Duel> hold_floor_duels(const std::string &set, const Mesh &mesh, const Parameters &parameters, int rounds);

}  // namespace bench
