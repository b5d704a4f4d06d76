#include "begin_collapses.hpp"

#include <algorithm>
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
  SolidMesh<m> mesh(put_in_order(original, boundary, job), original.values<m>(), scales, options.planes, job);
  keep(options.kept, mesh.origin, mesh.ranks);
  keep(options.restored, mesh.origin, mesh.ranks);
  for_flagged(options.touching, mesh.origin, [&](std::size_t v) { mesh.ranks[v] = Rank::touching; });
  return mesh;
}

/// By how much gradients differ within what the inner vertices stand for: interpolation loses the more.
template <std::size_t m>
double roughness(const SolidRemains<m> &solid) {
  double sum = 0;
  for (std::size_t v = 0; v < solid.points.size(); v++) {
    if (solid.ranks[v] >= Rank::boundary) continue;  // those have squares of planes, too
    const auto &a = solid.quadrics[v].a;
    for (std::size_t k = 0; k < 3; k++) {
      sum += a[entry_of(k, k)];
      for (std::size_t i = 3; i < 3 + m; i++) sum -= a[entry_of(i, k)] * a[entry_of(i, k)] / a[entry_of(i, i)];
    }
  }
  return sum;
}

/// What values are to a state of earlier ones: the squared error that they have there, and that of the collapses to
/// the size, to it and in all, if they lose as much as the earlier values, or less, being smoother.
struct NewValues {
  double error, usual_there, usual;

  /// The root of the whole is to be larger by no more than the part that is asked for. What collapses leave is less
  /// than what they cost, by experience; the first ones nearly as much.
  bool lose_too_much(double warm_start) const {
    constexpr double left_of_cost = 0.75, left_of_first = 0.9;
    const double allowed = ((1 + warm_start) * (1 + warm_start) - 1) * left_of_cost * usual;
    return error != 0 && !(error - left_of_first * usual_there <= allowed);
  }
};

/// The part of what is asked for that a state may lose: the nearer to the size, the less can be made good.
double to_be_made_good(std::size_t of_state, std::int64_t tets) {
  return std::min(double(of_state) / double(tets) - 1, 1.0);
}

/// The coarsest of the states that earlier values left that is fine enough for the size and for the new values.
template <std::size_t m>
std::optional<CollapseStart<m>> warm_start(const MeshView &original, const Boundary &boundary,
                                           const FieldsAsLengths<m> &fields, const SolidOptions &options,
                                           SolidHistory &history, Job &job) {
  constexpr double finer = 1.5;     // than the size: the last collapses see the new values
  constexpr double far_beyond = 8;  // what is asked for: a finer state will not do, either
  const std::int64_t tets = std::max(options.tets, options.enough);
  const double usual_cost = history.usual_cost(tets);
  const Array<SolidState<m>> &states = history.states<m>(job.memory);
  for (std::size_t i = states.size(); i-- > 0;) {
    const SolidState<m> &state = states[i];
    if (!state.progress.follows() || double(state.remains.tets.size()) < finer * double(tets)) continue;
    SolidRemains<m> remains(state.remains, job.memory);
    const double error = renew_quadrics(original, boundary, fields, state.progress.home, job, remains);
    const double of_earlier = roughness(state.remains), of_new = roughness(remains);
    const double share = of_new < of_earlier ? of_new / of_earlier : 1;
    const NewValues values{error, share * state.progress.cost, share * usual_cost};
    const double asked = to_be_made_good(state.remains.tets.size(), tets) * options.warm_start;
    if (!values.lose_too_much(asked)) {
      SolidMesh<m> solid(std::move(remains), job);
      SolidProgress progress(solid.points.size(), solid.tets.size(), job);
      return CollapseStart<m>{std::move(solid), std::move(progress), false};
    }
    if (values.lose_too_much(far_beyond * asked)) break;
  }
  return std::nullopt;
}

}  // namespace

template <std::size_t m>
CollapseStart<m> begin_collapses(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                                 const SolidOptions &options, SolidHistory &history, Job &job) {
  if (!options.restored.empty()) history.forget(job.memory);  // of what does not know them, to make room
  const bool keeps_states = options.max_deviation <= 0 && options.restored.empty() && !options.is_attempt &&
                            options.careful_from < std::int64_t(original.tets.size());
  if (keeps_states && history.is_earlier()) {
    if (auto start = warm_start(original, boundary, fields, options, history, job)) return std::move(*start);
    history.forget_earlier(job.memory);
  }
  const std::int64_t least = std::max({options.enough, options.careful_from, options.relaxed_from});
  const SolidState<m> *const state =
      keeps_states ? history.before<m>(options.tets, options.enough, least, job.memory) : nullptr;
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
