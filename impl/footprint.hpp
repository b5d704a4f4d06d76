// The memory that a run will take, from what is known before its dear stages.
#pragma once
#include <cstdint>

#include "budget.hpp"
#include "extract_boundary.hpp"
#include "prepare.hpp"

namespace tetlod {

/// What is to be expected of a run.
struct Outlook {
  double boundary_triangles = 0;            ///< of the original
  double points = 0, tets = 0;              ///< of the result
  double probes = 0;                        ///< of a run with a target; 0: none
  double solid_tets = 0, solid_points = 0;  ///< of the original, where its edges collapse; else 0
  double fields = 1;                        ///< that steer
  bool limits_deviation = false;
  bool has_rounds = false;   ///< of refine()
  double results_aside = 0;  ///< of attempts, while another is refined
};

/// Bytes of the largest stage that is still to come, beside what is in use after sampling. By experience: the
/// constants come from 48 sets, real ones and plates, beams and rings, of 3 K to 1.7 M tets and 1 K to 62 K boundary
/// triangles, 2 to 50 % kept.
double expected_bytes(const Outlook &outlook, const Input &input);

/// Of refine(), beside what is in use before it, the boundary too, with a mesh of so many tets.
std::size_t bytes_to_refine(const MeshView &original, std::int64_t tets, int rounds);

/// When boundary, samples and the first budget are known.
Outlook outlook_of(const Original &original, const Boundary &boundary, Span<const std::int32_t> samples,
                   const Options &options, const Budget &budget, const Report &report, Job &job);

}  // namespace tetlod
