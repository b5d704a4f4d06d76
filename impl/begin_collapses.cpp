#include "begin_collapses.hpp"

#include <optional>

#include "renew_quadrics.hpp"

namespace tetlod {

namespace {

/// Of original vertices, flagged: those that are left.
template <class Visit>
void for_flagged(Span<const std::uint8_t> flags, Span<const std::int32_t> origin, const Visit &visit) {
  for (std::size_t v = 0; v < origin.size() && !flags.empty(); v++)
    if (flags[std::size_t(origin[v])]) visit(v);
}

void keep(Span<const std::uint8_t> flags, Span<const std::int32_t> origin, Array<Rank> &ranks) {
  for_flagged(flags, origin, [&](std::size_t v) {
    ranks[v] = std::max(ranks[v], ranks[v] < Rank::boundary ? Rank::kept_inner : Rank::kept_boundary);
  });
}

template <std::size_t m>
SolidMesh<m> mesh_of(const MeshView &original, const Boundary &boundary, const SolidOptions &options,
                     const Values<m> &scales, Job &job) {
  SolidMesh<m> mesh(put_in_order(original, boundary, job), original.values<m>(), scales, job);
  keep(options.kept, mesh.origin, mesh.ranks);
  keep(options.restored, mesh.origin, mesh.ranks);
  for_flagged(options.touching, mesh.origin, [&](std::size_t v) { mesh.ranks[v] = Rank::touching; });
  return mesh;
}

/// The coarsest of the states that earlier values left that is fine enough for the size and for the new values.
template <std::size_t m>
std::optional<CollapseStart<m>> warm_start(const MeshView &original, const Boundary &boundary,
                                           const FieldsAsLengths<m> &fields, const SolidOptions &options,
                                           SolidHistory &history, Job &job) {
  constexpr double finer = 1.5;      // than the size: the last collapses see the new values
  constexpr double far_beyond = 16;  // what is allowed: a finer state will not do, either
  const std::int64_t tets = std::max(options.tets, options.enough);
  const double usual_cost = history.usual_cost(tets);
  const Array<SolidState<m>> &states = history.states<m>(job.memory);
  for (std::size_t i = states.size(); i-- > 0;) {
    const SolidState<m> &state = states[i];
    if (!state.progress.follows() || double(state.remains.tets.size()) < finer * double(tets)) continue;
    SolidRemains<m> remains(state.remains, job.memory);
    const double error = renew_quadrics(original, boundary, fields, state.progress.home, job, remains);
    if (!inherits_too_much(error, options.warm_start, usual_cost)) {
      SolidMesh<m> solid(std::move(remains), job);
      SolidProgress progress(solid.points.size(), solid.tets.size(), job);
      return CollapseStart<m>{std::move(solid), std::move(progress), false, error};
    }
    if (inherits_too_much(error, options.warm_start, far_beyond * usual_cost)) break;
  }
  return std::nullopt;
}

}  // namespace

/// The root of it all is to be larger by no more than the part that is asked for. What collapses leave is less than
/// what they cost, by experience.
bool inherits_too_much(double inherited, double warm_start, double cost) {
  constexpr double left_of_cost = 0.75;
  const double allowed = ((1 + warm_start) * (1 + warm_start) - 1) * left_of_cost * cost;
  return inherited != 0 && !(inherited <= allowed);
}

template <std::size_t m>
CollapseStart<m> begin_collapses(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                                 const SolidOptions &options, SolidHistory &history, Job &job) {
  if (!options.restored.empty()) history.forget(job.memory);  // of what does not know them, to make room
  const bool keeps_states = options.max_deviation <= 0 && options.restored.empty();
  if (keeps_states && history.is_earlier()) {
    if (auto start = warm_start(original, boundary, fields, options, history, job)) return std::move(*start);
    history.forget_earlier(job.memory);
  }
  const SolidState<m> *const state =
      keeps_states ? history.before<m>(options.tets, options.enough, job.memory) : nullptr;
  if (state)
    return {SolidMesh<m>(SolidRemains<m>(state->remains, job.memory), job), SolidProgress(state->progress, job.memory),
            true};
  SolidMesh<m> solid = mesh_of<m>(original, boundary, options, fields.scales, job);
  SolidProgress progress(solid.points.size(), solid.tets.size(), job);
  if (keeps_states && options.warm_start > 0) progress.follow(solid.origin, original.points.size());
  return {std::move(solid), std::move(progress), keeps_states};
}

template CollapseStart<1> begin_collapses(const MeshView &, const Boundary &, const FieldsAsLengths<1> &,
                                          const SolidOptions &, SolidHistory &, Job &);
template CollapseStart<2> begin_collapses(const MeshView &, const Boundary &, const FieldsAsLengths<2> &,
                                          const SolidOptions &, SolidHistory &, Job &);
template CollapseStart<3> begin_collapses(const MeshView &, const Boundary &, const FieldsAsLengths<3> &,
                                          const SolidOptions &, SolidHistory &, Job &);
template CollapseStart<4> begin_collapses(const MeshView &, const Boundary &, const FieldsAsLengths<4> &,
                                          const SolidOptions &, SolidHistory &, Job &);

}  // namespace tetlod
