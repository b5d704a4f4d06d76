// What a session submits, and what it finds in the answers.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "demand.hpp"
#include "session.hpp"

namespace fuzz {

namespace {

void fill_points(Block &block, const Mesh &mesh) {
  for (std::int64_t i = 0; i < block.layout().tuples; i++)
    for (std::int32_t k = 0; k < block.layout().components; k++)
      block.set(i, k, mesh.points[std::size_t(i)][std::size_t(k)]);
}

void fill_values(Block &block, const Mesh &mesh) {
  for (std::int64_t i = 0; i < block.layout().tuples; i++) block.set(i, 0, mesh.values[std::size_t(i)]);
}

/// What the base does to wild numbers is the host's affair: no overflow in it.
void fill_tets(Block &block, const Mesh &mesh, std::int32_t base) {
  for (std::int64_t t = 0; t < block.layout().tuples; t++)
    for (std::int32_t k = 0; k < 4; k++)
      block.set_integer(t, k, std::int64_t(std::uint64_t(mesh.tets[std::size_t(t)][std::size_t(k)]) + unsigned(base)));
}

std::int32_t any_real(Bytes &in) { return in.one_in(3) ? TETLOD_FLOAT32 : TETLOD_FLOAT64; }
std::int32_t any_integer(Bytes &in) { return in.one_in(2) ? TETLOD_INT64 : TETLOD_INT32; }

template <class T>
const T *view(const tetlod_context *context, tetlod_status (*call)(const tetlod_context *, tetlod_array *),
              std::int32_t type, std::int32_t components, std::int64_t &tuples) {
  tetlod_array array{};
  array.struct_size = sizeof array;
  const tetlod_status status = call(context, &array);
  DEMAND(status == TETLOD_OK, "a result can be viewed: %d", status);
  DEMAND(array.type == type && array.components == components && array.reserved == 0, "a view has its type");
  DEMAND(array.component_stride == sizeof(T) && array.tuple_stride == std::int64_t(sizeof(T)) * components,
         "a view is packed");
  tuples = array.tuples;
  return static_cast<const T *>(array.data);
}

}  // namespace

void Session::submit_all(const Mesh &mesh) {
  Bytes plain(nullptr, 0);
  submit_points(mesh, plain);
  submit_tets(mesh, plain);
  submit_values(mesh, plain);
}

void Session::submit_plain(const Mesh &mesh, std::int32_t base) {
  const std::uint8_t int64_with_base[] = {1, std::uint8_t(base)};
  Bytes plain(nullptr, 0), choice(int64_with_base, sizeof int64_with_base);
  submit_points(mesh, plain);
  submit_tets(mesh, choice);
  submit_values(mesh, plain);
}

void Session::submit_points(const Mesh &mesh, Bytes &in) {
  const std::int32_t type = any_real(in);
  const bool strided = in.one_in(2);
  const Layout layout = strided ? decode_layout(type, mesh.point_count(), 3, in) : packed(type, mesh.point_count(), 3);
  blocks_.push_back(std::make_unique<Block>(layout, !strided));
  points_ = blocks_.back().get();
  fill_points(*points_, mesh);
  const tetlod_array array = points_->array();
  const tetlod_status status = tetlod_submit_points(context_, &array);
  DEMAND(status == TETLOD_OK, "points are taken in every layout: %d %s", status, message().c_str());
  sound_points_ = mesh.sound && type == TETLOD_FLOAT64 ? mesh.id : 0;
}

void Session::submit_tets(const Mesh &mesh, Bytes &in) {
  const auto count = std::int64_t(mesh.tets.size());
  const std::int32_t type = any_integer(in);
  base_ = std::int32_t(in.below(2));
  const bool strided = in.one_in(2);
  const Layout layout = strided ? decode_layout(type, count, 4, in) : packed(type, count, 4);
  blocks_.push_back(std::make_unique<Block>(layout, !strided));
  tets_ = blocks_.back().get();
  fill_tets(*tets_, mesh, base_);
  const tetlod_array array = tets_->array();
  const tetlod_status status = tetlod_submit_tets(context_, &array, base_);
  DEMAND(status == TETLOD_OK, "tets are taken in every layout: %d %s", status, message().c_str());
  sound_tets_ = mesh.sound ? mesh.id : 0;
}

void Session::submit_values(const Mesh &mesh, Bytes &in) {
  const std::int32_t type = any_real(in);
  const bool strided = in.one_in(2);
  const Layout layout = strided ? decode_layout(type, mesh.point_count(), 1, in) : packed(type, mesh.point_count(), 1);
  blocks_.push_back(std::make_unique<Block>(layout, !strided));
  values_ = blocks_.back().get();
  fill_values(*values_, mesh);
  const tetlod_array array = values_->array();
  const tetlod_status status = tetlod_submit_scalars(context_, in.one_in(2) ? nullptr : "field", &array);
  DEMAND(status == TETLOD_OK, "values are taken in every layout: %d %s", status, message().c_str());
  sound_values_ = mesh.sound && type == TETLOD_FLOAT64 ? mesh.id : 0;
}

Fetched fetch(const tetlod_context *context) {
  Fetched result;
  std::int64_t points = 0, tets = 0, values = 0, triangles = 0;
  const double *const xyz = view<double>(context, tetlod_view_points, TETLOD_FLOAT64, 3, points);
  const std::int32_t *const corners = view<std::int32_t>(context, tetlod_view_tets, TETLOD_INT32, 4, tets);
  const double *const scalars = view<double>(context, tetlod_view_scalars, TETLOD_FLOAT64, 1, values);
  for (std::int64_t i = 0; i < points; i++) result.points.push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
  for (std::int64_t i = 0; i < 4 * tets; i += 4)
    result.tets.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
  result.values.assign(scalars, scalars + values);
  std::int64_t counted_points = 0, counted_tets = 0;
  tetlod_fetch_counts(context, &counted_points, &counted_tets, &triangles);
  DEMAND(counted_points == points && counted_tets == tets && values == points, "counts are those of the views");
  Block boundary(packed(TETLOD_INT64, triangles, 3));
  tetlod_array array = boundary.array();
  const tetlod_status status = tetlod_fetch_boundary(context, 0, &array);
  DEMAND(status == TETLOD_OK, "the boundary can be fetched: %d", status);
  for (std::int64_t i = 0; i < triangles; i++)
    result.boundary.push_back({boundary.integer(i, 0), boundary.integer(i, 1), boundary.integer(i, 2)});
  return result;
}

bool same(const Fetched &a, const Fetched &b) {
  return a.tets == b.tets && a.boundary == b.boundary && a.points.size() == b.points.size() &&
         a.values.size() == b.values.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point)) == 0 &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(double)) == 0;
}

void Session::accept(const Mesh &mesh, const Facts &facts) {
  last_ = fetch(context_);
  if (option(TETLOD_OPT_MERGE_TOLERANCE) == 0 && !facts.wide && !facts.gaps) {
    check_result(mesh, facts, *last_, takes_contacts());
    check_report(mesh, facts);
    check_flags(mesh, facts);
    if (const double bound = option(TETLOD_OPT_MAX_DEVIATION); bound > 0)
      check_deviation(mesh.points, facts.boundary, last_->points, last_->boundary, bound);
  } else {  // which points merge, or which tets are flat, is not found out again
    check_positive(last_->points, last_->tets);
    check_conforming(last_->tets, last_->boundary);
    takes_contacts() ? check_components(last_->points, last_->boundary) : check_surface(last_->points, last_->boundary);
    check_values(last_->values, facts.values_used.low, facts.values_used.high);
  }
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  tetlod_fetch_report(context_, &report);
  hash_ = report.hash;
  if (option(TETLOD_OPT_REMESH) == 0) DEMAND(report.remesh_attempts == 0, "nothing is remeshed with remesh 0");
  check_target();
  accept_fields(mesh);
}

/// Sorted by their names.
std::vector<std::pair<std::string, Block *>> Session::steering() const {
  std::vector<std::pair<std::string, Block *>> all;
  for (const Field &field : fields_)
    if (field.weight > 0) all.emplace_back(field.name, field.values);
  std::sort(all.begin(), all.end());
  return all;
}

/// Nothing overshoots.
void Session::check_steered(const Carried &field) const {
  const Block &original = *field.field.values;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::int64_t i = 0; i < original.layout().tuples; i++) {
    const double value = original.real(i, 0);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  for (const double value : field.values)
    DEMAND(value >= low && value <= high, "field %s: %.17g is in [%.17g, %.17g]", field.field.name.c_str(), value, low,
           high);
}

/// The bound is held, by what the report says and by what is measured.
void Session::check_target() const {
  const double bound = option(TETLOD_OPT_MAX_ERROR);
  if (bound <= 0) return;
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  tetlod_fetch_report(context_, &report);
  DEMAND(report.max_error <= bound, "max-error %.17g: the report has %.17g", bound, report.max_error);
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  const tetlod_status status = tetlod_measure_error(context_, 0, &error);
  DEMAND(status == TETLOD_OK || explains_limit(status), "a run can be measured: %d", status);
  if (status == TETLOD_OK) DEMAND(error.max <= bound, "max-error %.17g: %.17g is measured", bound, error.max);
}

void Session::check_report(const Mesh &mesh, const Facts &facts) const {
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  DEMAND(tetlod_fetch_report(context_, &report) == TETLOD_OK, "a run has a report");
  const auto same_count = [](const char *what, std::int64_t told, std::int64_t is) {
    DEMAND(told == is, "the report: %s are %ld, not %ld", what, long(is), long(told));
  };
  const Topology before = topology_of(facts.boundary), after = topology_of(last_->boundary);
  same_count("points_in", report.points_in, mesh.point_count());
  same_count("tets_in", report.tets_in, std::int64_t(mesh.tets.size()));
  if (facts.tets.size() == mesh.tets.size()) same_count("unused_points", report.unused_points, facts.unused);
  same_count("merged_points", report.merged_points, facts.coincident);
  if (before.closed && are_side_by_side(mesh.points, facts.tets)) same_count("moved_points", report.moved_points, 0);
  same_count("dropped_tets", report.dropped_tets, std::int64_t(mesh.tets.size() - facts.tets.size()));
  same_count("boundary_points_in", report.boundary_points_in, before.points);
  same_count("boundary_edges_in", report.boundary_edges_in, before.edges);
  same_count("boundary_triangles_in", report.boundary_triangles_in, before.triangles);
  same_count("boundary_points_out", report.boundary_points_out, after.points);
  same_count("boundary_edges_out", report.boundary_edges_out, after.edges);
  same_count("boundary_triangles_out", report.boundary_triangles_out, after.triangles);
  same_count("points_out", report.points_out, std::int64_t(last_->points.size()));
  same_count("tets_out", report.tets_out, std::int64_t(last_->tets.size()));
  same_count("points of every kind",
             report.boundary_points_out + report.samples + report.steiner_points + report.inserted_points,
             report.points_out);
  same_count("samples", report.selected_samples - report.samples_outside - report.samples_too_near >= report.samples,
             1);
  DEMAND(report.scalar_min == facts.values.low && report.scalar_max == facts.values.high,
         "the report has the range of the values");
  const bool is_sized = option(TETLOD_OPT_TARGET_RATIO) > 0 || option(TETLOD_OPT_MAX_ERROR) > 0;
  if (is_sized || report.moved_points > 0) return;  // vertices have moved
  std::vector<std::pair<Point, double>> original;
  for (std::size_t v = 0; v < mesh.points.size(); v++) original.emplace_back(mesh.points[v], mesh.values[v]);
  const auto first = std::size_t(report.boundary_points_out);
  for (std::size_t i = first; i < first + std::size_t(report.samples); i++) {
    const bool found = std::find(original.begin(), original.end(),
                                 std::make_pair(last_->points[i], last_->values[i])) != original.end();
    DEMAND(found, "sample %zu is an original vertex with its value", i - first);
  }
}

void Session::check(const Disturbance &disturbance) {
  tetlod_mesh_report report;
  std::memset(&report, 0x5a, sizeof report);
  const tetlod_mesh_report untouched = report;
  report.struct_size = sizeof report;
  const Mesh mesh = this->mesh();
  const tetlod_status status = disturbed(disturbance, [&] { return tetlod_check(context_, &report); });
  check_documented("tetlod_check", status,
                   {TETLOD_ERR_STATE, TETLOD_ERR_MEMORY_LIMIT, TETLOD_ERR_CANCELLED, TETLOD_ERR_TIME_LIMIT});
  check_trouble("tetlod_check", status, disturbance);
  check_kept();
  if (status != TETLOD_OK) {
    const std::size_t head = sizeof report.struct_size;
    DEMAND(std::memcmp(reinterpret_cast<const char *>(&report) + head,
                       reinterpret_cast<const char *>(&untouched) + head, sizeof report - head) == 0,
           "tetlod_check writes on success alone");
    return;
  }
  if (mesh.values.size() != mesh.points.size() || option(TETLOD_OPT_MERGE_TOLERANCE) > 0) return;
  const Facts facts = facts_of(mesh, {false, takes_contacts(), repairs(TETLOD_OPT_ON_OVERLAP)});
  if (facts.wide || facts.gaps) return;
  const auto same_count = [&](const char *what, const tetlod_defect &told, std::int64_t is) {
    DEMAND(told.count == is, "tetlod_check: %s are %ld, not %ld", what, long(is), long(told.count));
    DEMAND((told.first < 0) == (is == 0), "tetlod_check: %s have a first one", what);
  };
  same_count("index", report.index, facts.index);
  same_count("repeated", report.repeated, facts.repeated);
  same_count("nonfinite_points", report.nonfinite_points, facts.nonfinite_points);
  same_count("nonfinite_values", report.nonfinite_values, facts.nonfinite_values);
  same_count("coincident", report.coincident, facts.coincident);
  same_count("flat", report.flat, facts.flat);
  same_count("inverted", report.inverted, facts.inverted);
  same_count("duplicate", report.duplicate, facts.duplicate);
  same_count("nonmanifold_faces", report.nonmanifold_faces, facts.nonmanifold_faces);
  same_count("unused", report.unused, facts.unused);
  if (!complete() || disturbance.any() || !fields_fit()) return;
  const tetlod_status after = run({});
  if (after == TETLOD_ERR_MEMORY_LIMIT || after == TETLOD_ERR_TIME_LIMIT) return;
  const bool is_crossed = report.status == TETLOD_ERR_MESH_INTERSECTING;
  if (is_crossed && (after == TETLOD_OK || after == TETLOD_ERR_MAX_ERROR)) return;    // no more so, or refused sooner
  if (after == TETLOD_ERR_BACKEND_MISSING && option(TETLOD_OPT_REMESH) == 0) return;  // before it looks at the mesh
  if (report.status != TETLOD_OK)
    DEMAND(after == report.status, "tetlod_check says %d, tetlod_run %d: %s", report.status, after, said_.c_str());
  else if (after != TETLOD_ERR_MESH_DEGENERATE || mesh.sound)  // too thin for the remesher: it is not called to check
    DEMAND(after == TETLOD_OK || after == TETLOD_ERR_REMESH || after == TETLOD_ERR_BACKEND_MISSING ||
               after == TETLOD_ERR_MAX_ERROR,
           "tetlod_check says nothing, tetlod_run %d: %s", after, said_.c_str());
}

}  // namespace fuzz
