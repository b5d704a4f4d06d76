// One contestant in a process of its own, where the system has yet to hand out the memory that it takes, as in most
// programs. Prints its wall and CPU seconds, which leave reading the mesh out.
//
// bench_contestant MESH peer|fast|accurate TARGET THREADS
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "mesh_file.hpp"
#include "run_peer.hpp"
#include "run_tetlod.hpp"

namespace {

std::int32_t preset_of(const char *name) {
  for (const std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    if (std::strcmp(name, bench::preset_name(preset)) == 0) return preset;
  }
  throw std::runtime_error(std::string(name) + ": no contestant");
}

bench::Cost run(const bench::Mesh &mesh, const char *who, double target, std::int64_t threads) {
  if (std::strcmp(who, "peer") == 0) return bench::Peer(mesh).run(std::int64_t(target * double(mesh.tets.size()))).cost;
  bench::Parameters parameters;
  parameters.preset = preset_of(who);
  parameters.target = target;
  parameters.threads = threads;
  return bench::run_tetlod(mesh, parameters).cost;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 5) return EXIT_FAILURE;
  try {
    const bench::Cost cost = run(bench::read_mesh_file(argv[1]), argv[2], std::atof(argv[3]), std::atoll(argv[4]));
    std::printf("%.6f %.6f\n", cost.wall, cost.cpu);
    return EXIT_SUCCESS;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_contestant: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
