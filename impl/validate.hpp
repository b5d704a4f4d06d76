// Defects of the input, counted and named.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "pipeline.hpp"
#include "status.hpp"

namespace tetlod {

/// A class of defects: how many, and the first culprit, numbered from the input's index base (-1: none).
struct Defect {
  std::int64_t count = 0;
  std::int64_t first = -1;
  void add(std::int64_t culprit) {
    if (count == 0 || culprit < first) first = culprit;
    count++;
  }
};

struct Defects {
  std::int64_t points = 0, tets = 0;
  Defect index;                                         ///< tets that name a vertex that is not there
  Defect repeated;                                      ///< tets with a vertex twice, also after merging
  Defect nonfinite_points;                              ///< used points with a coordinate that is not finite
  Defect nonfinite_values;                              ///< used points with a value that is not finite
  Defect coincident;                                    ///< points that are merged into an earlier one
  Defect flat;                                          ///< tets without volume
  Defect inverted;                                      ///< tets with negative det(p1 - p0, p2 - p0, p3 - p0)
  Defect duplicate;                                     ///< tets with the four vertices of an earlier one
  Defect nonmanifold_faces;                             ///< faces with more than two tets; the first tet
  Defect overlapping;                                   ///< faces with both tets on one side; the first tet
  Defect unused;                                        ///< points that no tet uses
  Defect nonmanifold_edges;                             ///< boundary edges with more than two faces; the lower vertex
  Defect nonmanifold_points;                            ///< boundary points where surface sheets touch
  std::int64_t boundary_triangles = 0, components = 0;  ///< 0 where the boundary cannot be made out
};

/// Looks at everything, stops at nothing but the job's limits. Shapes of the input are sound.
Defects find_defects(const Input &input, const Options &options, Job &job);

/// What a run with an undecimated boundary would say of the mesh before remeshing; Status::ok when nothing. Throws what
/// is not the mesh's fault. defects: those found.
Error verdict_on(const Input &input, const Options &options, const Defects &defects, Job &job);

/// Throws the status of the first class that has defects and whose policy is policy_error.
void refuse_defects(const Defects &defects, const Options &options);

/// Whether refuse_defects could refuse anything that the run itself would not.
bool any_strict_policy(const Options &options);

}  // namespace tetlod
