// Which states of the collapses of a solid are kept, for other sizes or other values to begin at.
#pragma once
#include "decimate_solid.hpp"
#include "solid_places.hpp"
#include "solid_state.hpp"

namespace tetlod {

/// Tets that new values may begin with, for the memory's sake.
inline std::int64_t most_for_new_values(const SolidMeasures &of_original) { return std::int64_t(of_original.tets / 2); }

template <std::size_t m>
class StateKeeper {
 public:
  /// states: null: none are kept.
  StateKeeper(Array<SolidState<m>> *states, const SolidOptions &options, Job &job)
      : states_(states), options_(options), job_(job) {}

  /// So many bytes, which others will use.
  void leave(std::size_t bytes) { of_others_ = bytes; }

  /// Unless it is of this target alone, where only new values may begin, of rules that relax further in some runs than
  /// in others, kept already, or would take memory that the run does not need without it. Where new values may begin
  /// must not depend on the peak, which depends on the threads. While vertices are removed the way is mostly that to
  /// all smaller targets, too: such states take the place of others. count: of the tets that are left.
  void keep(SolidRemains<m> &remains, const SolidProgress &progress, std::int64_t count) {
    const bool of_this_target = progress.largest_target < options_.tets, follows = progress.follows();
    const bool is_way_of_all = progress.relaxed < SolidPlaces<m>::most_for_slivers;
    if (!states_ || (of_this_target && !follows) || !is_way_of_all) return;
    const auto last_is_no_finer = [&] {
      return !states_->empty() && states_->back().remains.tets.size() <= remains.tets.size();
    };
    while (progress.removes() && last_is_no_finer() && !states_->back().progress.removes()) states_->pop_back();
    if (last_is_no_finer()) return;
    if (follows ? count > most_for_new_values(remains.measures) : takes_too_much(remains, progress)) return;
    remains.give_spare_back();
    job_.poll(0);  // each of both copies large arrays
    kept_ += remains.bytes() + progress.bytes();
    states_->push_back({SolidRemains<m>(remains, job_.memory), SolidProgress(progress, job_.memory)});
    if (of_this_target) states_->back().progress.allow(-1);  // no size of the same values begins there
  }

 private:
  /// Than the peak so far, now or later; where other sizes are likely to follow, than a quarter more.
  bool takes_too_much(const SolidRemains<m> &remains, const SolidProgress &progress) {
    const std::size_t peak = job_.memory.peak();
    if (most_ == 0) most_ = options_.one_of_many ? peak / 4 * 5 : peak;
    const std::size_t of_lists = SolidComplex::bytes_of_lists(remains.points.size(), remains.tets.size());
    const std::size_t in_use = job_.memory.in_use() + of_others_ - remains.spare_bytes();
    return std::max(in_use + of_lists, options_.later + kept_) + remains.bytes() + progress.bytes() > most_;
  }

  Array<SolidState<m>> *states_;
  const SolidOptions &options_;
  Job &job_;
  std::size_t of_others_ = 0;
  std::size_t kept_ = 0, most_ = 0;  // bytes of those that came to them, and in all while they come; 0: to be found
};

}  // namespace tetlod
