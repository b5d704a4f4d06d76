// From the caller's arrays to the decimated boundary: prepare, extract, topology, decimation, stage by stage.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "budget.hpp"
#include "decimate_boundary.hpp"
#include "demand.hpp"
#include "extract_boundary.hpp"
#include "find_crossing.hpp"
#include "geometry.hpp"
#include "oracle.hpp"
#include "prepare.hpp"
#include "stages.hpp"
#include "surface_distance.hpp"
#include "surface_topology.hpp"

namespace fuzz {

namespace {

using tetlod::Status;

tetlod::Options decode_options(Bytes &in) {
  tetlod::Options options;
  if (in.one_in(4)) options.merge_tolerance = 0.1 * in.fraction() * in.fraction();
  if (in.one_in(4)) options.on_nonfinite = tetlod::policy_repair;
  options.sigma = in.one_in(2) ? in.fraction() : 0;
  options.lambda = in.one_in(4) ? 1e6 * in.fraction() : 0.1;
  if (in.one_in(4)) options.clean_edges = 0.1 * in.fraction();
  if (in.one_in(2)) options.target_ratio = 0.1;  // parts may be in contact
  return options;
}

/// Whatever is merged, what is left is a mesh.
void check_original(const tetlod::Original &original) {
  const auto count = std::int32_t(original.view.points.size());
  for (const tetlod::Tet &t : original.view.tets) {
    const std::set<std::int32_t> corners(t.begin(), t.end());
    DEMAND(corners.size() == 4, "a prepared tet has four vertices");
    DEMAND(*corners.begin() >= 0 && *corners.rbegin() < count, "a prepared tet's vertices are there");
    for (const std::int32_t v : t) {
      const tetlod::Vec3 &p = original.view.points[std::size_t(v)];
      DEMAND(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "used coordinates are finite");
      const double value = original.view.scalars[std::size_t(v)];
      DEMAND(value >= original.scalar_min && value <= original.scalar_max, "the range has the value %g", value);
    }
  }
}

/// Faces turned so that the lowest vertex comes first, in order: equal for the same surface.
std::vector<Face> sorted(std::vector<Face> faces) {
  for (Face &face : faces) std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  std::sort(faces.begin(), faces.end());
  return faces;
}

void check_boundary(const tetlod::Boundary &boundary, const tetlod::MeshView &mesh, const Facts &facts) {
  DEMAND(sorted(faces_of(boundary.triangles)) == sorted(facts.boundary),
         "the boundary is the faces used once, outward");
  DEMAND(boundary.tet_of.size() == boundary.triangles.size(), "a boundary triangle has a tet");
  std::set<std::int32_t> used, outer;
  for (const Corners &tet : facts.tets) used.insert(tet.begin(), tet.end());
  for (std::size_t i = 0; i < boundary.triangles.size(); i++) {
    const tetlod::Tet &tet = mesh.tets[std::size_t(boundary.tet_of[i])];
    for (const std::int32_t v : boundary.triangles[i]) {
      DEMAND(std::count(tet.begin(), tet.end(), v), "a boundary triangle is of its tet");
      outer.insert(v);
    }
  }
  std::vector<std::int32_t> interior;
  std::set_difference(used.begin(), used.end(), outer.begin(), outer.end(), std::back_inserter(interior));
  DEMAND(std::equal(interior.begin(), interior.end(), boundary.interior.begin(), boundary.interior.end()),
         "interior vertices are those that the boundary does not use");
}

void check_topology(const tetlod::Surface &surface, const tetlod::SurfaceTopology &topology) {
  const Topology plain = topology_of(faces_of(surface.triangles));
  DEMAND(plain.closed, "an extracted boundary is closed");
  DEMAND(topology.edges == plain.edges && topology.used_points == plain.points, "edges and points are counted");
  DEMAND(topology.components >= plain.components, "the cut surface has more components, not fewer");
  const auto next = [](std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
  const auto corner = [&](std::int32_t h) { return surface.triangles[std::size_t(h / 3)][std::size_t(h % 3)]; };
  for (std::int32_t h = 0; h < std::int32_t(topology.mate.size()); h++) {
    const std::int32_t mate = topology.mate[std::size_t(h)];
    DEMAND(mate >= 0 && mate != h && topology.mate[std::size_t(mate)] == h, "half-edges are mates of each other");
    DEMAND(corner(h) == corner(next(mate)) && corner(next(h)) == corner(mate), "mates run the other way");
    const std::int32_t sheet = topology.sheet_vertex[std::size_t(h)];
    DEMAND(topology.vertex_of[std::size_t(sheet)] == corner(h), "a vertex of the cut surface is one of the surface");
    DEMAND(sheet == topology.sheet_vertex[std::size_t(next(mate))], "mates have the same ends in the cut surface");
  }
}

void check_locked(const tetlod::Surface &before, const std::vector<std::uint8_t> &locked,
                  const tetlod::Surface &after) {
  std::map<std::int32_t, tetlod::Vec3> kept;
  for (std::size_t i = 0; i < after.points.size(); i++)
    if (after.origin[i] >= 0) kept[after.origin[i]] = after.points[i];
  for (std::size_t i = 0; i < locked.size(); i++) {
    if (!locked[i]) continue;
    const auto place = kept.find(before.origin[i]);
    DEMAND(place != kept.end() && place->second == before.points[i], "a locked point stays where it is");
  }
}

bool crosses(const tetlod::Surface &surface, tetlod::Job &job) {
  tetlod::TreeOnDemand tree(surface);
  return tetlod::find_crossing(surface, tree, job).first >= 0;
}

void check_decimated(const tetlod::Surface &before, const tetlod::Surface &after, const tetlod::DecimateReport &report,
                     bool crossed, tetlod::Job &job) {
  DEMAND(after.points.size() == after.scalars.size() && after.points.size() == after.origin.size(),
         "a point has a value and an origin");
  DEMAND(report.edges_out <= report.edges_in, "decimation makes no edges");
  DEMAND(report.edges_out == std::int64_t(3 * after.triangles.size() / 2), "a triangle has one and a half edges");
  const auto [low, high] = std::minmax_element(before.scalars.begin(), before.scalars.end());
  check_values(std::vector<double>(after.scalars.begin(), after.scalars.end()), *low, *high);
  DEMAND(topology_of(faces_of(after.triangles)).closed, "a decimated boundary is closed");
  check_same_topology(faces_of(before.triangles), faces_of(after.triangles));
  if (crossed) return;
  DEMAND(!crosses(after, job), "decimation makes no crossing");
  check_same_cut_topology(points_of(before.points), faces_of(before.triangles), points_of(after.points),
                          faces_of(after.triangles));
}

std::vector<std::uint8_t> decode_locks(Bytes &in, std::size_t points) {
  std::vector<std::uint8_t> locked;
  if (!in.one_in(4)) return locked;
  for (std::size_t i = 0; i < points; i++) locked.push_back(in.one_in(2));
  return locked;
}

tetlod::Span<const std::uint8_t> span(const std::vector<std::uint8_t> &bytes) { return {bytes.data(), bytes.size()}; }

void copy(const tetlod::Surface &from, tetlod::Surface &to) {
  to.points = from.points;
  to.scalars = from.scalars;
  to.origin = from.origin;
  to.triangles = from.triangles;
}

/// None, that of a run with a target size, any.
double decode_field_weight(Bytes &in, const tetlod::Surface &surface) {
  if (in.one_in(2)) return 0;
  const auto [low, high] = std::minmax_element(surface.scalars.begin(), surface.scalars.end());
  const double range = surface.scalars.empty() ? 0 : *high - *low;
  const double usual = range > 0 ? tetlod::box_of(surface.points).diagonal() / range : 0;
  return in.one_in(4) ? std::abs(in.real()) : tetlod::field_weight * usual;
}

void decimate(Stage &stage, const tetlod::Surface &before, const tetlod::SurfaceTopology &topology,
              const tetlod::Options &options, Bytes &in) {
  const std::vector<std::uint8_t> locked = decode_locks(in, before.points.size());
  const bool crossed = crosses(before, stage.job());
  const double field_weight = decode_field_weight(in, before);
  const double bound = in.one_in(4) ? in.fraction() * in.fraction() : 0;
  const double max_deviation = before.points.empty() ? 0 : bound * tetlod::box_of(before.points).diagonal();
  const tetlod::DecimateOptions how{options.sigma, options.lambda, options.clean_edges, max_deviation, {field_weight}};
  tetlod::Surface after(stage.memory());
  copy(before, after);
  tetlod::DecimateReport report;
  stage.trouble(in);
  const Status status = stage.call("decimate_boundary", {}, [&] {
    report = tetlod::decimate_boundary(after, topology, span(locked), how, stage.job());
  });
  stage.calm();
  if (status != Status::ok) return;
  trace("%lld of %lld edges are left%s\n", (long long)report.edges_out, (long long)report.edges_in,
        crossed ? ", of a surface that crosses itself" : "");
  check_decimated(before, after, report, crossed, stage.job());
  check_locked(before, locked, after);
  if (max_deviation > 0)
    check_deviation(points_of(before.points), faces_of(before.triangles), points_of(after.points),
                    faces_of(after.triangles), bound);
}

void run_stages(Stage &stage, const Mesh &mesh, Bytes &in) {
  const tetlod::Options options = decode_options(in);
  trace(mesh);
  const MeshInput holder(mesh);
  tetlod::Original original(stage.memory());
  const Facts facts =
      facts_of(mesh, {options.on_nonfinite == tetlod::policy_repair, tetlod::takes_contacts(options), false});
  const Status prepared =
      stage.call("prepare_original", {Status::mesh_empty, Status::mesh_index, Status::mesh_nonfinite},
                 [&] { tetlod::prepare_original(holder.input(), options, stage.job(), original); });
  if (prepared != Status::ok) return;
  check_original(original);

  tetlod::Boundary boundary(stage.memory());
  const Status extracted = stage.call("extract_boundary", {Status::mesh_nonmanifold, Status::mesh_degenerate},
                                      [&] { tetlod::extract_boundary(original.view, stage.job(), boundary); });
  if (options.merge_tolerance == 0 && !facts.wide && !facts.gaps) {
    if (extracted == Status::mesh_nonmanifold) DEMAND(facts.nonmanifold_faces, "a face has more than two tets");
    if (extracted == Status::mesh_degenerate) DEMAND(facts.boundary.empty(), "there is no boundary");
    if (extracted == Status::ok) check_boundary(boundary, original.view, facts);
  }
  if (extracted != Status::ok) return;

  tetlod::Surface surface(stage.memory());
  tetlod::SurfaceTopology topology(stage.memory());
  const Status found = stage.call("find_topology", {Status::mesh_intersecting}, [&] {
    tetlod::make_surface(original.view, boundary.triangles, stage.job(), surface);
    tetlod::find_topology(surface.points, surface.triangles, stage.job(), topology);
  });
  if (mesh.sound && options.merge_tolerance == 0)
    DEMAND(found != Status::mesh_intersecting, "a sound mesh does not overlap itself");
  if (found != Status::ok) return;
  stage.calm();
  check_topology(surface, topology);
  decimate(stage, surface, topology, options, in);
}

}  // namespace

}  // namespace fuzz

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  fuzz::settle();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Bytes in(data, size);
  const fuzz::Mesh mesh = fuzz::decode_mesh(in);
  fuzz::Stage stage(in);
  fuzz::run_stages(stage, mesh, in);
  return 0;
}
