// What is left of a solid between two rounds of collapses, kept so that other sizes of the same mesh begin there.
#pragma once
#include <limits>
#include <variant>

#include "fingerprint.hpp"
#include "solid_mesh.hpp"

namespace tetlod {

/// No admissible edge of a vertex costs less, as far as was known in that round. At first, and where what its edges
/// cost has changed since, it is to be looked for, and counts as cheaper than all.
struct CheapestEdge {
  double cost = -std::numeric_limits<double>::infinity(), t = 0;
  std::int32_t other = -1;
  int round = -1;

  bool is_found() const { return cost != CheapestEdge().cost; }
};

/// How far the rounds are, and what they know.
struct SolidProgress {
  /// Before the first round.
  SolidProgress(std::size_t vertices, std::size_t tets, Job &job);
  SolidProgress(const SolidProgress &of, Memory &memory);

  std::size_t bytes() const {
    return cheapest.size() * (sizeof(CheapestEdge) + sizeof(int)) + (home.size() + into.size()) * sizeof(std::int32_t);
  }
  /// From here on `home` is known. origin: of each vertex, the original one.
  void follow(Span<const std::int32_t> origin, std::size_t originals);
  bool follows() const { return !home.empty(); }
  /// Of the vertices that are left alone. number: numbers_of(left).
  void close_gaps(Span<const std::int32_t> number, Job &job);

  /// For larger targets the round that is done would have been another one.
  void allow(double target) { largest_target = std::min(largest_target, std::int64_t(std::floor(target))); }
  /// Gaps are closed with `count` tets, or not, and if that is not due for every size, because this one is near or far.
  void allow_by_gaps(std::int64_t count, bool closed) {
    if (!follows() || count < next_closing) return;
    if (closed) allow(-1);
    largest_size = std::min(largest_size, count / 2 - 1);
  }
  /// Far from so many tets vertices are removed, near them, or where no more may go, edges collapse. From here on it is
  /// so with `count` tets.
  void choose_way(std::int64_t count, std::int64_t tets);
  /// No more vertices may go.
  void end_removals(std::int64_t count) { first_near = count; }
  static constexpr double usually_far = 3, far_in_haste = 1.5;  ///< times the tets
  /// Vertices, which costs are of.
  bool removes() const { return first_near == 0; }
  /// Whether the ways so far were those to so many tets.
  bool leads_to(std::int64_t tets) const { return is_far(last_far, tets) && !is_far(first_near, tets); }

  double far = usually_far;  ///< times the tets
  int round = 0;
  std::int64_t last_far = std::numeric_limits<std::int64_t>::max();        ///< tets, when that was chosen last
  std::int64_t first_near = 0;                                             ///< tets, when it was not for the first time
  bool most_waited = false;                                                ///< in the round before
  int relaxed = 0;                                                         ///< rules, where little was admissible
  std::int64_t largest_target = std::numeric_limits<std::int64_t>::max();  ///< up to it the rounds so far are the same
  std::int64_t largest_size = std::numeric_limits<std::int64_t>::max();    ///< likewise, as gaps were left
  std::int64_t next_closing = 0;                                           ///< with fewer tets, gaps are closed
  double cost = 0;                                                         ///< of all collapses so far
  Array<CheapestEdge> cheapest;                                            ///< of each vertex
  Array<int> moved;          ///< the round in which each vertex moved last
  Array<std::int32_t> home;  ///< of each original vertex, the one it had become when gaps were closed last, or -1
  Array<std::int32_t> into;  ///< of each vertex, the one that it has collapsed into since, or itself

 private:
  bool is_far(std::int64_t count, std::int64_t tets) const { return double(count) >= far * double(tets); }
};

template <std::size_t m>
struct SolidState {
  SolidRemains<m> remains;
  SolidProgress progress;
};

/// What states are of, beside a mesh and its values.
struct CollapseWay {
  bool holds_bound = false, hasty = false;  ///< as in SolidOptions
  bool keeps_earlier = false;               ///< states of earlier values, for warm starts
  double planes = 1;                        ///< as in SolidOptions

  bool operator==(const CollapseWay &o) const {
    return holds_bound == o.holds_bound && hasty == o.hasty && keeps_earlier == o.keeps_earlier && planes == o.planes;
  }
};

/// Of one mesh and its values, each state coarser than the one before.
class SolidHistory {
 public:
  explicit SolidHistory(Memory &memory) : states_(Array<SolidState<1>>(&memory)) {}

  /// Forgets the states, unless they are of the same values, or those of earlier ones are to be kept; and of another
  /// way.
  void begin(const MeshView &original, const CollapseWay &way, Job &job);
  bool is_earlier() const { return !(now_ == values_); }
  /// Whether it began with these values before.
  bool is_repeated() const { return repeated_; }
  void forget_earlier(Memory &memory);
  void forget(Memory &memory);

  /// What collapses to so many tets cost in all, about, as they did for the values of the states.
  double usual_cost(std::int64_t tets) const;
  bool knows_usual_cost() const { return tets_of_cost_ > 0; }
  void set_usual_cost(double cost, std::int64_t tets) {
    usual_cost_ = cost;
    tets_of_cost_ = tets;
  }

  /// The coarsest of the states of `least` tets or more that the rounds to a target go through, or to `tets` if those
  /// are more; null: none is kept.
  template <std::size_t m>
  const SolidState<m> *before(std::int64_t target, std::int64_t tets, std::int64_t least, Memory &memory) {
    const std::int64_t size = std::max(target, tets);
    const SolidState<m> *last = nullptr;
    for (const SolidState<m> &state : states<m>(memory))
      if (target <= state.progress.largest_target && size <= state.progress.largest_size &&
          state.progress.leads_to(size) && std::int64_t(state.remains.tets.size()) >= least)
        last = &state;
    return last;
  }

  template <std::size_t m>
  Array<SolidState<m>> &states(Memory &memory) {
    using States = Array<SolidState<m>>;
    States *const states = std::get_if<States>(&states_);
    return states ? *states : states_.emplace<States>(&memory);
  }

 private:
  CollapseWay way_;
  bool repeated_ = false;
  Fingerprint values_, now_;
  double usual_cost_ = 0;
  std::int64_t tets_of_cost_ = 0;
  std::variant<Array<SolidState<1>>, Array<SolidState<2>>, Array<SolidState<3>>, Array<SolidState<4>>> states_;
};

}  // namespace tetlod
