#include "boundary_duel.hpp"

#include "decimate_and_check.hpp"
#include "extract_boundary.hpp"
#include "face_pass.hpp"
#include "run_rival.hpp"
#include "stages.hpp"
#include "surface_topology.hpp"

namespace bench {
namespace {

class BoundaryStage {
 public:
  BoundaryStage(const Mesh &mesh, std::int64_t threads)
      : stages_(threads), mesh_(view_of(mesh)), boundary_(stages_.memory) {
    extract();
  }

  Cost extract() {
    boundary_ = tetlod::Boundary(stages_.memory);
    const Stopwatch watch;
    tetlod::extract_boundary(mesh_, stages_.job, boundary_);
    return watch.cost();
  }

  tetlod::Surface surface() {
    tetlod::Surface made(stages_.memory);
    tetlod::make_surface(mesh_, boundary_.triangles, stages_.job, made);
    return made;
  }

  std::int64_t edges() {
    const tetlod::Surface whole = surface();
    tetlod::SurfaceTopology topology(stages_.memory);
    tetlod::find_topology(whole.points, whole.triangles, stages_.job, topology);
    return topology.edges;
  }

  Cost decimate(double sigma) {
    tetlod::Surface made = surface();
    tetlod::DecimateOptions options;
    options.sigma = sigma;
    const Stopwatch watch;
    tetlod::SurfaceTopology topology(stages_.memory);
    tetlod::find_topology(made.points, made.triangles, stages_.job, topology);
    tetlod::decimate_and_check(made, topology, options, 0, stages_.job,
                               [&](tetlod::Surface &surface, const tetlod::DecimateOptions &way) {
                                 return tetlod::decimate_boundary(surface, topology, {}, way, stages_.job);
                               });
    return watch.cost();
  }

 private:
  Stages stages_;
  tetlod::MeshView mesh_;
  tetlod::Boundary boundary_;
};

}  // namespace

std::vector<Duel> hold_boundary_duels(const std::string &set, const Mesh &mesh, double sigma, std::int64_t threads,
                                      int rounds) {
  BoundaryStage stage(mesh, 1), extraction(mesh, threads);
  FacePass pass(mesh.tets, threads);
  const tetlod::Surface surface = stage.surface();
  const SurfaceOnDisk file(reinterpret_cast<const Point *>(surface.points.data()), surface.points.size(),
                           surface.triangles.data(), surface.triangles.size());
  const std::string arguments =
      "'" + file.path() + "' " + std::to_string(static_cast<std::int64_t>(sigma * double(stage.edges())));
  const auto ours = [&] { return stage.decimate(sigma); };
  const auto against = [&](const char *rival, const char *program, const char *package) {
    return hold_duel("decimating the boundary", set, rival, rounds, ours,
                     [&] { return run_rival(program, arguments, package); });
  };
  return {hold_duel(
              "extracting the boundary", set, "one pass over the faces", rounds, [&] { return extraction.extract(); },
              [&] { return pass.run(); }),
          against("GTS, volume and shape", "bench_gts", "libgts-dev"),
          against("CGAL, Lindstrom-Turk", "bench_cgal", "libcgal-dev")};
}

}  // namespace bench
