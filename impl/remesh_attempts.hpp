// The ladder of attempts to remesh: what TetGen is given at first, and what when that has failed.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "remesh_result.hpp"

namespace tetlod {

/// The same for every attempt.
struct RemeshProblem {
  const Surface &surface;
  Span<const Vec3> samples;
  Box box;                  ///< of the surface
  std::int64_t components;  ///< as in SurfaceFacts
  Job &job;
};

struct RemeshAttempt {
  const char *name;
  RemeshInput (*input)(const RemeshProblem &, double fraction);  ///< fraction is told to the job
  bool about_samples;                                            ///< the same as the first attempt when there are none
};

Span<const RemeshAttempt> remesh_attempts();

}  // namespace tetlod
