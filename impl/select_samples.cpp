#include "select_samples.hpp"

#include "budget.hpp"
#include "sample_interior.hpp"
#include "sample_residual.hpp"

namespace tetlod {

namespace {

void sample_where_not_linear(const Original &original, const Boundary &boundary, std::size_t samples, Job &job,
                             Array<std::int32_t> &selected) {
  const std::size_t points = original.view.points.size();
  Array<std::uint8_t> is_interior(points, 0, &job.memory), on_boundary(points, 0, &job.memory);
  for (std::int32_t v : boundary.interior) is_interior[std::size_t(v)] = 1;
  for (const Triangle &t : boundary.triangles)
    for (std::int32_t v : t) on_boundary[std::size_t(v)] = 1;
  Array<std::int32_t> vertices(boundary.interior, &job.memory);
  for (std::size_t v = 0; v < points; v++)
    if (on_boundary[v]) vertices.push_back(std::int32_t(v));
  selected.clear();
  sample_residual(original.view, vertices, is_interior, samples, job, selected);
}

}  // namespace

void select_samples(const Original &original, const Boundary &boundary, const Options &options, std::size_t samples,
                    Job &job, Array<std::int32_t> &selected) {
  if (as_published(options)) {
    const double variation = options.rho * original.range;
    Array<std::int32_t> vertices(boundary.interior, &job.memory);  // which sampling sorts
    sample_interior(original.view, {vertices.data(), vertices.size()}, variation, job, selected);
  } else {
    sample_where_not_linear(original, boundary, samples, job, selected);
  }
  if (!original.flags.empty()) add_flagged(original.flags, boundary.interior, selected);
}

}  // namespace tetlod
