#include "decimate_solid_and_check.hpp"

#include <algorithm>

#include "attempts.hpp"
#include "came_from.hpp"
#include "deviation.hpp"
#include "lower_deviation.hpp"
#include "move_outward.hpp"
#include "nested_solids.hpp"
#include "status.hpp"
#include "tet_checks.hpp"

namespace tetlod {

namespace {

constexpr double most_missed = 0.01;
/// Times the tets that are left: before, hardly any collapse takes the boundary through itself, as triangles are small.
constexpr std::int64_t late = 8;

Array<std::uint8_t> touching_vertices(const OriginalSolid &original, Memory &memory) {
  const SurfaceTopology &topology = original.topology;
  Array<std::uint8_t> touching(&memory);
  if (topology.nonmanifold_points == 0 && topology.nonmanifold_edges == 0) return touching;
  touching.resize(original.mesh.points.size(), 0);
  for (std::size_t p = 0; p < topology.touching.size(); p++)
    if (topology.touching[p]) touching[std::size_t(original.surface.origin[p])] = 1;
  return touching;
}

bool same_topology(const SurfaceTopology &a, const SurfaceTopology &b) {
  return a.components == b.components && a.nonmanifold_edges == b.nonmanifold_edges &&
         a.nonmanifold_points == b.nonmanifold_points;
}

/// But where solids of the original are in contact: each is simplified for itself.
void refuse_new_intersections(const OriginalSolid &original, Job &job, CoarseSolid &coarse, TreeOnDemand &tree) {
  try {
    refuse_intersections(coarse.surface, coarse.topology, tree, 0, job);
  } catch (const Error &error) {
    if (error.status() != Status::mesh_intersecting || original.find_contacts(job).empty()) throw;
    Array<std::int32_t> vertex(&job.memory);
    for (const std::int32_t point : coarse.surface.origin)
      vertex.push_back(came_from(coarse.origin[std::size_t(point)]));
    const Array<std::int32_t> components = original_components(coarse.surface.triangles, coarse.topology, vertex,
                                                               original.surface, original.topology, job.memory);
    refuse_intersections(coarse.surface, coarse.topology, tree, 0, job, {&original.find_contacts(job), components});
    coarse.in_contact = true;
  }
}

/// What is wrong, where it is not closed, of the same topology, crosses itself nowhere, and none of its components lies
/// in another's material.
std::string check_surface_of(const OriginalSolid &original, Job &job, CoarseSolid &coarse, TreeOnDemand &tree) {
  const TetMesh &mesh = coarse.mesh;
  make_surface({mesh.points, mesh.scalars, mesh.tets, original.mesh.fields}, mesh.boundary, job, coarse.surface);
  try {
    find_topology(coarse.surface.points, coarse.surface.triangles, job, coarse.topology);
    coarse.wants_care = !same_topology(coarse.topology, original.topology);
    if (coarse.wants_care) return "the boundary has another topology";
    tree = TreeOnDemand(coarse.surface);
    refuse_new_intersections(original, job, coarse, tree);
    return {};
  } catch (const Error &error) {
    // Its vertices have no names that the host knows.
    coarse.wants_care = true;
    if (error.status() == Status::mesh_intersecting) return "the boundary crosses or touches itself";
    if (error.status() == Status::mesh_nonmanifold) return "the boundary is no manifold";
    throw;
  }
}

bool misses_size(const SolidOptions &options, const TetMesh &mesh) {
  return options.enough == 0 && double(mesh.tets.size()) > (1 + most_missed) * double(options.tets);
}

/// tree: becomes that of the surface, if the mesh is sound.
void check(const OriginalSolid &original, const SolidOptions &options, Job &job, CoarseSolid &coarse,
           TreeOnDemand &tree) {
  TetMesh &mesh = coarse.mesh;
  std::string &wrong = coarse.wrong = make_all_positive(mesh.points, {mesh.tets.data(), mesh.tets.size()}, 1, job);
  if (wrong.empty()) wrong = check_volume(mesh.points, mesh.tets, mesh.boundary, 1, job);
  if (wrong.empty()) wrong = check_surface_of(original, job, coarse, tree);
  coarse.is_sound = wrong.empty();
  if (coarse.is_sound && misses_size(options, mesh))
    wrong = text("no edge is left to collapse at %zu tets", mesh.tets.size());
}

/// Of original vertices: those that are kept or restored, and where the solid touches itself.
Array<std::uint8_t> vertices_that_stay(const SolidOptions &options, Memory &memory) {
  Array<std::uint8_t> stay(&memory);
  for (const Span<const std::uint8_t> &some : {options.kept, options.restored, options.touching}) {
    if (stay.size() < some.size()) stay.resize(some.size(), 0);
    for (std::size_t v = 0; v < some.size(); v++) stay[v] |= some[v];
  }
  return stay;
}

/// The least distance that is lowered, the most tets that it may come to, and whether crossings are guarded against.
struct Lowering {
  double least;
  std::int64_t most;
  bool is_guarded = false;
};

/// Takes the boundary back to where it is farthest off, if a least distance is given from there on, else outward before
/// that, where the outcome is sound. Not where solids are in contact, as what is nearest may be another's.
bool lower(const OriginalSolid &original, const SolidOptions &options, const Lowering &how, Job &job,
           CoarseSolid &coarse) {
  CoarseSolid lowered(job.memory);
  lowered.mesh = coarse.mesh;
  lowered.origin = coarse.origin;
  lowered.reused = coarse.reused;
  lowered.careful_from = coarse.careful_from;
  const Array<std::uint8_t> stay = vertices_that_stay(options, job.memory);
  const BoundaryMoves by{original.surface, original.tree.get(job), stay, how.is_guarded};
  if (how.least == 0) move_outward(by, job, lowered.mesh, lowered.origin);
  lowered.deviation = lower_deviation(by, how.least, how.most, job, lowered.mesh, lowered.origin);
  TreeOnDemand tree;
  check(original, options, job, lowered, tree);
  const bool is_taken = lowered.is_sound && !lowered.in_contact;
  if (is_taken) coarse = std::move(lowered);
  return is_taken;
}

/// Where it crosses itself else; that takes longer.
bool lower_guarded(const OriginalSolid &original, const SolidOptions &options, Lowering how, Job &job,
                   CoarseSolid &coarse) {
  how.is_guarded = true;
  bool is_sound = false;
  attempt_in_memory(job, [&] { is_sound = lower(original, options, how, job, coarse); });
  return is_sound;
}

CoarseSolid decimate_and_check(const OriginalSolid &original, const SolidOptions &options, std::int64_t lowered,
                               SolidHistory &history, Job &job) {
  CoarseSolid coarse(job.memory);
  coarse.careful_from = options.careful_from;
  coarse.reused = decimate_solid(original, options, history, job, coarse.mesh, coarse.origin);
  if (lowered > 0 && lower(original, options, {0, lowered}, job, coarse)) return coarse;
  TreeOnDemand tree;
  check(original, options, job, coarse, tree);
  const bool may_lower = coarse.is_sound && !coarse.in_contact;
  if (!coarse.is_sound || (lowered > 0 && may_lower && lower_guarded(original, options, {0, lowered}, job, coarse)))
    return coarse;
  coarse.deviation =
      largest_deviation(original.surface, original.tree, coarse.surface, std::move(tree), options.measured_at, job);
  const double far = far_off * box_of(original.surface.points).diagonal();
  const Lowering back{far / 2, std::int64_t(coarse.mesh.tets.size())};
  if (lowered == 0 && may_lower && options.max_deviation <= 0 && coarse.deviation > far)
    lower(original, options, back, job, coarse) || lower_guarded(original, options, back, job, coarse);
  return coarse;
}

/// decimate_and_check, with more care than options say where that has to be.
CoarseSolid decimate_with_care(const OriginalSolid &original, SolidOptions options, std::int64_t lowered,
                               SolidHistory &history, Job &job) {
  Array<std::int32_t> component(&job.memory);
  const auto let_contacts_meet = [&] {
    const Contacts &contacts = original.find_contacts(job);
    if (contacts.empty()) return;
    component = components_of_vertices(original.surface, original.topology, original.mesh.points.size(), job.memory);
    options.may_meet = {&contacts, component};
  };
  if (options.careful_from > 0) let_contacts_meet();
  CoarseSolid best = decimate_and_check(original, options, lowered, history, job);
  const std::int64_t reused = best.reused;  // of other runs
  const auto all = std::int64_t(original.mesh.tets.size()), few = late * std::int64_t(best.mesh.tets.size());
  const bool can_reach_size = !misses_size(options, best.mesh);
  bool again = best.wants_care && options.careful_from < all;
  if (again && options.careful_from == 0) let_contacts_meet();
  for (options.careful_from = options.careful_from > 0 ? all : std::min(few, all); again; options.careful_from = all) {
    if (job.log) job.log(1, ("edges collapse again, with more care: " + best.wrong).c_str());
    if (!best.is_sound) best = CoarseSolid(job.memory);
    CoarseSolid careful(job.memory);
    const auto attempt = [&] { careful = decimate_and_check(original, options, lowered, history, job); };
    if (!best.is_sound)
      attempt();
    else if (!attempt_in_memory(job, attempt))
      break;
    again = !careful.wrong.empty() && options.careful_from < all && (can_reach_size || !careful.is_sound);
    if (is_better(careful, best)) best = std::move(careful);
  }
  best.reused = reused;
  return best;
}

/// Nothing is wrong with the mesh, or what the caller may take all the same: what relaxed rules led to, or about the
/// size.
bool may_be_taken(const CoarseSolid &coarse, const SolidOptions &options) {
  constexpr double about = hardly_more * hardly_more;
  const bool has_size = double(coarse.mesh.tets.size()) <= about * double(options.tets);
  return coarse.is_sound && (coarse.wrong.empty() || options.may_relax || has_size);
}

/// The boundary is farther off than `far`: ends of thin parts slide within their own planes, where nothing holds them.
bool went_astray(const CoarseSolid &coarse, const SolidOptions &options, double far) {
  const bool has_limit = options.max_deviation > 0;
  return may_be_taken(coarse, options) && !has_limit && options.enough == 0 && coarse.deviation > far;
}

bool is_nearer(const CoarseSolid &a, const CoarseSolid &b, std::int64_t size) {
  const double most = hardly_more * std::max(double(size), double(b.mesh.tets.size()));
  return a.is_sound && double(a.mesh.tets.size()) <= most && a.deviation < b.deviation;
}

}  // namespace

bool is_better(const CoarseSolid &a, const CoarseSolid &b) {
  return !b.is_sound || (a.is_sound && a.mesh.tets.size() < b.mesh.tets.size());
}

CoarseSolid decimate_solid_and_check(const OriginalSolid &original, SolidOptions options, std::int64_t lowered,
                                     SolidHistory &history, Job &job) {
  const Array<std::uint8_t> touching = touching_vertices(original, job.memory);
  options.touching = touching;
  CoarseSolid coarse = decimate_with_care(original, options, lowered, history, job);
  const double diagonal = box_of(original.surface.points).diagonal();
  if (!went_astray(coarse, options, 2 * far_off * diagonal)) return coarse;
  options.careful_from = coarse.careful_from;
  for (const double limit : {far_off, 2 * far_off}) {
    if (job.log)
      job.log(1, text("the boundary is %s of the diagonal off: edges collapse again, to %s at most",
                      about(coarse.deviation / diagonal).c_str(), about(limit).c_str())
                     .c_str());
    options.max_deviation = limit * diagonal;
    CoarseSolid nearer(job.memory);
    if (!attempt_in_memory(job, [&] { nearer = decimate_with_care(original, options, lowered, history, job); })) break;
    if (!is_nearer(nearer, coarse, options.tets)) continue;
    nearer.reused = coarse.reused;
    if (coarse.wrong.empty()) nearer.wrong.clear();  // the size serves as well
    return nearer;
  }
  return coarse;
}

}  // namespace tetlod
