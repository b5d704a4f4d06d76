#include "location_duel.hpp"

#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include "extract_boundary.hpp"
#include "locate.hpp"
#include "measure_error.hpp"
#include "run_tetlod.hpp"
#include "stages.hpp"
#include "vtk_grid.hpp"

namespace bench {
namespace {

constexpr std::int64_t kTetLeaf = 500;  // the paper's

// Sums the field at the points, so that nothing is left out.
Cost locate_with_vtk(vtkUnstructuredGrid &grid, const Mesh &in, const std::vector<Point> &points, double &sum) {
  const Stopwatch watch;
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(&grid);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  double parametric[3], weights[4];
  sum = 0;
  for (Point p : points) {
    const vtkIdType found = locator->FindCell(p.data(), 0, cell, parametric, weights);
    if (found < 0) continue;
    for (std::size_t k = 0; k < 4; k++) sum += weights[k] * in.values[std::size_t(in.tets[std::size_t(found)][k])];
  }
  return watch.cost();
}

class LocateStage {
 public:
  LocateStage(const Mesh &mesh, std::int64_t threads)
      : stages_(threads), mesh_(view_of(mesh)), range_(range_of(mesh.values)), boundary_(stages_.memory) {
    tetlod::extract_boundary(mesh_, stages_.job, boundary_);
  }

  Cost in_original(const Mesh &result) {
    tetlod::Array<tetlod::Place> places(&stages_.memory);
    const Stopwatch watch;
    tetlod::locate(mesh_, boundary_.triangles, view_of(result).points, {}, kTetLeaf, stages_.job, places);
    return watch.cost();
  }

  Cost in_result(const tetlod::TetMesh &result) {
    const Stopwatch watch;
    tetlod::measure_error(mesh_, range_, result, 0, 1, stages_.job);
    return watch.cost();
  }

  tetlod::TetMesh copy_of(const Mesh &mesh) {
    const tetlod::MeshView view = view_of(mesh);
    tetlod::TetMesh copy(stages_.memory);
    copy.points.assign(view.points.begin(), view.points.end());
    copy.scalars.assign(view.scalars.begin(), view.scalars.end());
    copy.tets.assign(view.tets.begin(), view.tets.end());
    return copy;
  }

 private:
  Stages stages_;
  tetlod::MeshView mesh_;
  double range_;
  tetlod::Boundary boundary_;
};

}  // namespace

std::vector<Duel> hold_location_duels(const std::string &set, const Mesh &mesh, double target, std::int64_t threads,
                                      int rounds) {
  Parameters parameters;
  parameters.preset = TETLOD_PRESET_FAST;
  parameters.target = target;
  const Mesh result = run_tetlod(mesh, parameters).result;
  const auto original_grid = grid_for_vtk(mesh), result_grid = grid_for_vtk(result);
  LocateStage stage(mesh, threads);
  const tetlod::TetMesh copy = stage.copy_of(result);
  const std::string rival = "VTK's static cell locator";
  double sum = 0;
  return {hold_duel(
              "locating result's vertices in original", set, rival, rounds, [&] { return stage.in_original(result); },
              [&] { return locate_with_vtk(*original_grid, mesh, result.points, sum); }),
          hold_duel(
              "locating original's vertices in result", set, rival, rounds, [&] { return stage.in_result(copy); },
              [&] { return locate_with_vtk(*result_grid, result, mesh.points, sum); })};
}

}  // namespace bench
