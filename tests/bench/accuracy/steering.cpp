#include "steering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench_context.hpp"
#include "mesh_shape.hpp"
#include "stopwatch.hpp"
#include "vectors.hpp"

namespace bench {
namespace {

using Values = std::vector<double>;

// Of the linear function on a tet, times six volumes.
Point gradient_by_volume(const Mesh &mesh, const Tet &tet) {
  Point edges[3], gradient{};
  double rises[3];
  for (std::size_t k = 0; k < 3; k++) {
    edges[k] = minus(mesh.points[std::size_t(tet[k + 1])], mesh.points[std::size_t(tet[0])]);
    rises[k] = mesh.values[std::size_t(tet[k + 1])] - mesh.values[std::size_t(tet[0])];
  }
  for (std::size_t k = 0; k < 3; k++) {
    const Point area = cross(edges[(k + 1) % 3], edges[(k + 2) % 3]);
    for (std::size_t axis = 0; axis < 3; axis++) gradient[axis] += rises[k] * area[axis];
  }
  return gradient;
}

// The length of the mean gradient of the tets at each point, by volume.
Values gradient_lengths(const Mesh &mesh) {
  std::vector<Point> sums(mesh.points.size(), Point{});
  Values volumes(mesh.points.size(), 0), lengths;
  for (const Tet &tet : mesh.tets) {
    const Point gradient = gradient_by_volume(mesh, tet);
    const double volume = six_volumes(mesh, tet), sign = volume < 0 ? -1 : 1;
    for (const std::int32_t v : tet) {
      for (std::size_t axis = 0; axis < 3; axis++) sums[std::size_t(v)][axis] += sign * gradient[axis];
      volumes[std::size_t(v)] += std::fabs(volume);
    }
  }
  for (std::size_t v = 0; v < sums.size(); v++)
    lengths.push_back(volumes[v] > 0 ? std::sqrt(dot(sums[v], sums[v])) / volumes[v] : 0);
  return lengths;
}

// Across the unit cube that the mesh's box becomes.
Values front_across(const Mesh &mesh) {
  Point low = mesh.points[0], high = low;
  for (const Point &p : mesh.points)
    for (std::size_t axis = 0; axis < 3; axis++) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  const auto part = [&](const Point &p, std::size_t axis) { return (p[axis] - low[axis]) / (high[axis] - low[axis]); };
  Values front;
  for (const Point &p : mesh.points) front.push_back(std::tanh(12 * (part(p, 0) + 0.3 * part(p, 1) - 0.6)));
  return front;
}

struct Outcome {
  Mesh result;  // with the scalars
  Values second;
  double cpu;
};

// The second field rides along where its weight is 0.
Outcome run(const Mesh &mesh, const Values &second, double weight, const SteeringOptions &options) {
  const Context owner = make_context();
  tetlod_context *const context = owner.get();
  const tetlod_array array = lent(TETLOD_FLOAT64, second.size(), 1, second.data());
  check(tetlod_set_preset(context, TETLOD_PRESET_ACCURATE), context);
  check(tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, options.target), context);
  check(tetlod_set_int(context, TETLOD_OPT_THREADS, options.threads), context);
  submit(context, mesh);
  check(tetlod_submit_steering(context, "second", weight, &array), context);
  const Stopwatch watch;
  check(tetlod_run(context), context);
  Outcome outcome{{}, {}, watch.cost().cpu};
  outcome.result.points = copied<Point>(viewed(tetlod_view_points, context));
  outcome.result.tets = copied<Tet>(viewed(tetlod_view_tets, context));
  outcome.result.values = copied<double>(viewed(tetlod_view_scalars, context));
  outcome.second.resize(outcome.result.points.size());
  tetlod_array room = lent(TETLOD_FLOAT64, outcome.second.size(), 1, outcome.second.data());
  check(tetlod_fetch_field(context, "second", &room), context);
  return outcome;
}

Mesh with_values(Mesh mesh, const Values &values) {
  mesh.values = values;
  return mesh;
}

Steering measured(const Mesh &first, const Mesh &second, Outcome outcome) {
  Steering steering;
  const std::vector<Triangle> boundary = shape_of(outcome.result).boundary;
  steering.of_first = measure_field_error(first, outcome.result, boundary);
  steering.of_second = measure_field_error(second, with_values(outcome.result, outcome.second), boundary);
  steering.kept = double(outcome.result.tets.size()) / double(first.tets.size());
  steering.cpu = outcome.cpu;
  return steering;
}

std::string text_of(double weight) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", weight);
  return text;
}

void add_rows(const Mesh &first, const std::string &name, const Values &values, const SteeringOptions &options,
              std::vector<Steering> &rows) {
  const Mesh second = with_values(first, values);
  const auto add = [&](const std::string &weight, Steering row) {
    row.second = name;
    row.weight = weight;
    rows.push_back(row);
  };
  const auto beside = [&](double weight) { return measured(first, second, run(first, values, weight, options)); };
  add("0", beside(0));
  for (const double weight : options.weights) add(text_of(weight), beside(weight));
  Steering alone = measured(second, first, run(second, first.values, 0, options));
  std::swap(alone.of_first, alone.of_second);
  add("alone", alone);
}

}  // namespace

std::vector<Steering> measure_steering(const Mesh &mesh, const SteeringOptions &options) {
  std::vector<Steering> rows;
  add_rows(mesh, "gradient", gradient_lengths(mesh), options, rows);
  add_rows(mesh, "front", front_across(mesh), options, rows);
  return rows;
}

void write_steering_head(std::FILE *to) {
  std::fputs(
      "| set, second field | weight | first: RMS (largest), % | second | tets kept, % | CPU s |\n"
      "|---|---|---|---|---|---|\n",
      to);
}

void write_steering(std::FILE *to, const std::string &set, const Steering &s) {
  std::fprintf(to, "| %s, %s | %s | %.2f (%.1f) | %.2f (%.1f) | %.2f | %.2f |\n", set.c_str(), s.second.c_str(),
               s.weight.c_str(), 100 * s.of_first.rms, 100 * s.of_first.max, 100 * s.of_second.rms,
               100 * s.of_second.max, 100 * s.kept, s.cpu);
  std::fflush(to);
}

}  // namespace bench
