// The paper's way from the boundary to a mesh: decimation, culling, remeshing, values.
#pragma once
#include <optional>
#include <string>

#include "beginning.hpp"
#include "kept_vertices.hpp"
#include "reconstruct_field.hpp"
#include "surface_distance.hpp"
#include "surface_topology.hpp"

namespace tetlod {

class Remeshing : public Beginning {
 public:
  Remeshing(const Input &input, const Options &options, Prepared &prepared, Job &job, Result &result)
      : Beginning(input, options, prepared, job, result), mesh_(result.mesh) {}

 protected:
  void decimate(double sigma);

  /// As the paper does: fills the boundary, decimated less where TetGen finds no way.
  void simplify(Worker &worker);

  void reconstruct_field();

  /// False: to too many tets, or, as TetGen finds no way, to none; nor where the boundary has no volume left as doubles
  /// round, if collapses have a result.
  bool remesh_to_target(Worker &worker);

  /// Of the original's boundary.
  TreeOnDemand &tree();

  TetMesh &mesh_;
  Ladder ladder_ = Ladder::whole;
  std::string failure_;  // of the last remeshing, or, without one, of the first collapses
  std::optional<TreeOnDemand> tree_;
  SurfaceTopology topology_{job_.memory};  // of the simplified boundary
  KeptVertices kept_{original_.flags, job_.memory};
  Array<std::int32_t> origin_{&job_.memory};  // of each point of mesh_, the original vertex that it is; else below 0

 private:
  void decimate_and_sample();
  void meet_target(Worker &worker);
  bool fill(Worker &worker);
  void refuse_overlapping_solids();
  bool has_contacts();
  void cull();
  void remesh(Worker &worker);
  void measure_deviation();

  Surface surface_{job_.memory};               // the simplified boundary
  Array<std::int32_t> samples_{&job_.memory};  // after culling
  RemeshResult remeshed_{job_.memory};
};

}  // namespace tetlod
