#include "decimate_solid.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "begin_collapses.hpp"
#include "beside.hpp"
#include "boundary_limits.hpp"
#include "came_from.hpp"
#include "solid_blocks.hpp"
#include "solid_work.hpp"
#include "state_keeper.hpp"
#include "status.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Part of the vertices whose cheapest edges a round looks at. A smaller one comes nearer to the cheapest edge of all
/// first, and loses no less; of removals a larger one does.
constexpr double part_of_round = 0.33, part_of_removals = 0.5, part_in_haste = 0.7;
/// Tets that a collapse takes away, about.
constexpr double tets_a_collapse = 5.5;
/// Of so many vertices one is left, or less: memory has become free then, and threads are idle soon.
constexpr std::size_t to_one_left = 5;

template <std::size_t m>
class SolidDecimator {
 public:
  /// states: those that are kept; null: none are.
  SolidDecimator(const OriginalSolid &original, const SolidOptions &options, const FieldsAsLengths<m> &fields,
                 CollapseStart<m> &&start, Array<SolidState<m>> *states, Job &job)
      : original_(original.mesh),
        tree_(original.tree),
        fields_(fields),
        options_(options),
        job_(job),
        mesh_(std::move(start.solid)),
        progress_(std::move(start.progress)),
        costs_(mesh_, progress_),
        places_(mesh_, blocks_, options.holds_bound, original.surface.points.size()),
        keeper_(states, options, job),
        count_(std::int64_t(mesh_.tets.size())),
        blocks_(mesh_.points.size(), job.memory),
        rooms_(&job.memory),
        works_(&job.memory),
        left_(mesh_.points.size(), 0, &job.memory) {
    std::iota(left_.begin(), left_.end(), 0);
    rooms_.reserve(SolidBlocks::most);
    works_.reserve(SolidBlocks::most);
    for (std::size_t b = 0; b < SolidBlocks::most; b++) {
      rooms_.emplace_back(job.memory);
      works_.emplace_back(job.memory);
    }
    if (progress_.relaxed > 0) places_.relax(progress_.relaxed);
    if (options.hasty) progress_.far = SolidProgress::far_in_haste;
    if (options.max_deviation > 0)
      limits_.limit_deviation(original.surface, original.tree.get(job), options.max_deviation, job);
  }

  void run() {
    const double surplus = double(count_ - options_.tets);
    const std::int64_t near_enough = options_.tets + options_.tets / 1000;  // the largest errors get a little less then
    std::optional<Beside> tree;
    for (double limit; count_ > near_enough && (limit = limit_of_round()) < infinity;) {
      if (!tree && tree_is_due()) {
        keeper_.leave(tree_.bytes_to_make());
        tree.emplace(job_, [this] { make_tree(); });
      }
      if (count_ < options_.enough && limit > options_.dearest) break;
      if (count_ <= options_.careful_from && !limits_.guards_crossings())
        limits_.guard_crossings(mesh_.points, mesh_.triangles, {}, job_, options_.may_meet, mesh_.origin);
      job_.poll(1 - double(count_ - options_.tets) / surplus);
      collapse_some(limit);
      keep_where(left_, job_, [&](std::size_t i) { return mesh_.has_vertex(left_[i]); });
      progress_.round++;
      const bool due = gaps_are_due();
      progress_.allow_by_gaps(count_, due);
      if (due)
        close_gaps();
      else
        mesh_.tidy({rooms_.data(), rooms_.size()}, job_);
    }
    if (tree) tree->finish();
  }

  /// The end of it.
  void write(TetMesh &out, Array<std::int32_t> &origin) {
    Array<std::int32_t> known(original_.points.size(), -1, &job_.memory), number(mesh_.points.size(), -1, &job_.memory);
    for (std::int32_t v : left_) known[std::size_t(mesh_.origin[std::size_t(v)])] = v;
    for (std::size_t i = 0; i < known.size(); i++) {
      job_.poll_at(i, 1);
      const std::int32_t v = known[i];
      if (v < 0) continue;
      const bool moved = mesh_.point(v) != original_.points[i];
      number[std::size_t(v)] = std::int32_t(out.points.size());
      out.points.push_back(mesh_.point(v));
      const Values<m> values = moved ? values_of(v) : original_.values<m>()[i];
      out.scalars.insert(out.scalars.end(), values.begin(), values.end());
      origin.push_back(moved ? moved_away(std::int32_t(i)) : std::int32_t(i));
    }
    keep_left(mesh_.tets, number, job_);
    keep_left(mesh_.triangles, number, job_);
    out.tets = std::move(mesh_.tets);
    out.boundary = std::move(mesh_.triangles);
  }

  std::int64_t count() const { return count_; }
  double cost() const { return progress_.cost; }  ///< of the collapses

 private:
  /// Tets that it comes to, unless nothing is admissible; the way depends on them.
  std::int64_t size() const { return std::max(options_.tets, options_.enough); }

  /// The round of a vertex none of whose edges is admissible.
  static constexpr int stuck = -2;

  /// It will be asked for, and the last collapses leave threads idle.
  bool tree_is_due() const {
    const std::size_t bytes = tree_.bytes_to_make();
    return job_.parallel.threads() > 1 && left_.size() * to_one_left < original_.points.size() && bytes > 0 &&
           job_.memory.in_use() + bytes <= job_.memory.peak();
  }

  void make_tree() {
    try {
      tree_.get(job_);
    } catch (const Error &error) {  // where memory is short it is made later, when collapses have given theirs back
      if (error.status() != Status::memory && error.status() != Status::memory_limit) throw;
    }
  }

  Values<m> values_of(std::int32_t v) const {
    Values<m> values;
    for (std::size_t i = 0; i < m; i++) values[i] = mesh_.lengths(v)[i] / fields_.scales[i];
    return fields_.range.clamp(values);
  }

  CheapestEdge &cheapest(std::int32_t v) { return progress_.cheapest[std::size_t(v)]; }
  const CheapestEdge &cheapest(std::int32_t v) const { return progress_.cheapest[std::size_t(v)]; }

  // ---- Rounds

  /// As below; infinite: nothing is admissible, however rules relax.
  double limit_of_round() {
    while (count_ <= options_.relaxed_from && progress_.relaxed <= places_.most_for_slivers) relax();
    double limit = limit_by_costs();
    while (limit == infinity && goes_on()) limit = limit_by_costs();
    return limit;
  }

  /// Where no vertex may be removed edges collapse, and where none may rules relax.
  bool goes_on() {
    if (!progress_.removes()) return relax();
    progress_.end_removals(count_);
    look_again();
    return true;
  }

  bool relax() {
    const bool may_fold = options_.may_relax && !options_.holds_bound;
    if (progress_.relaxed == (may_fold ? places_.most_of_all : places_.most_for_slivers)) return false;
    places_.relax(++progress_.relaxed);
    look_again();
    return true;
  }

  /// What an edge of the round may cost. Towards the end rounds get smaller, so that the last collapses are the
  /// cheapest. Before that a sample says enough, and what others cost is looked for when their turn comes.
  double limit_by_costs() {
    constexpr std::size_t enough = 4096;  // in a sample
    choose_way();
    const double most = part_of_vertices() * double(left_.size()),
                 needed = 1 + double(count_ - options_.tets) / tets_a_collapse;
    progress_.allow(double(count_) - most * tets_a_collapse);
    const auto wanted = std::size_t(std::min(most, needed)), step = wanted / enough + 1;
    Array<std::int32_t> sample(&job_.memory);
    for (std::size_t i = 0; i < left_.size(); i += step) sample.push_back(left_[i]);
    costs_.find_missing(most < needed ? sample : left_, job_);
    const double about = costs_.of_cheapest(wanted / step, sample, job_.memory);
    if (about < infinity) return about;
    costs_.find_missing(left_, job_);
    return costs_.of_cheapest(wanted, left_, job_.memory);
  }

  double part_of_vertices() const {
    if (!progress_.removes()) return part_of_round;
    return options_.hasty ? part_in_haste : part_of_removals;
  }

  /// What edges are known to cost is of one way alone.
  void choose_way() {
    const bool removed = progress_.removes();
    progress_.choose_way(count_, size());
    if (progress_.removes() != removed) look_again();
  }

  void look_again() {
    for_each(left_.size(), job_, [&](std::size_t i) { cheapest(left_[i]) = CheapestEdge(); });
  }

  void collapse_some(double limit) {
    Array<std::int32_t> items(left_, &job_.memory);
    keep_where(items, job_, [&](std::size_t i) { return cheapest(items[i]).cost <= limit; });
    blocks_.cut(mesh_, left_, progress_.round, most_blocks(items.size()), job_);
    for (std::int32_t v : items) works_[blocks_.of(v)].items.push_back(v);
    const double share = double(count_ - options_.tets) / double(items.size());
    const Array<std::size_t> order = longest_first();
    job_.parallel.for_blocks(order.size(), 1, [&](std::size_t i, std::size_t) {
      const std::size_t b = order[i];
      SolidWork<m> &work = works_[b];
      work.most = std::int64_t(std::ceil(share * double(work.items.size())));
      collapse_in_block(limit, work, rooms_[b]);
    });
    take_over(items.size());
  }

  /// The blocks: the last ones to be done are short, so that threads end at about the same time.
  Array<std::size_t> longest_first() {
    Array<std::size_t> order(blocks_.count(), 0, &job_.memory);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const std::size_t of_a = works_[a].items.size(), of_b = works_[b].items.size();
      return of_a != of_b ? of_a > of_b : a < b;
    });
    return order;
  }

  /// Few are soon done; what guards the boundary against crossings is one for all; where most wait, one block gets on.
  std::size_t most_blocks(std::size_t items) const {
    constexpr std::size_t few = 512;
    return items < few || limits_.guards_crossings() || progress_.most_waited ? 1 : SolidBlocks::most;
  }

  void collapse_in_block(double limit, SolidWork<m> &work, CollapseRoom &room) {
    for (std::size_t i = 0; i < work.items.size() && work.done.gone < work.most; i++) {
      if (i % 64 == 0) job_.poll(0);
      mesh_.prefetch_after(i, work.items);
      if (find(work.items[i], limit, work)) make(work.collapse, work, room);
    }
  }

  void take_over(std::size_t items) {
    RoundSums sums;
    for (SolidWork<m> &work : works_) {
      if (!work.items.empty())  // with fewer tets to lose, the block would have stopped before
        progress_.allow(double(count_) - double(work.done.gone + 1) * double(items) / double(work.items.size()));
      sums.add(work.done);
      work.done = {};
      work.items.clear();
    }
    count_ -= sums.gone;
    progress_.cost += sums.cost;
    progress_.most_waited = sums.most_waited();
    // Where rules refuse many, ever dearer edges would collapse instead of the cheapest ones.
    const std::size_t refused = progress_.relaxed < places_.most_for_slivers ? sums.slivers : sums.refused;
    if (sums.outnumber_collapses(refused)) relax();
  }

  // ---- States

  /// Now and then, and when new values may begin near the size: as many tets as there are with gaps were left last
  /// time.
  bool gaps_are_due() const {
    if (!limits_.empty() || count_ <= options_.tets) return false;
    const std::int64_t near = std::min(2 * size(), most_for_new_values(mesh_.measures));
    const bool comes_near = progress_.follows() && count_ <= near && std::int64_t(mesh_.tets.size()) > near;
    return comes_near || count_ < progress_.next_closing;
  }

  /// What is left moves together, so that it is near in memory.
  void close_gaps() {
    while (progress_.next_closing > count_) progress_.next_closing /= 2;
    const Array<std::int32_t> number = numbers_of(left_, mesh_.points.size(), job_);
    SolidRemains<m> remains = mesh_.take_remains(number, job_);
    progress_.close_gaps(number, job_);
    for (CollapseRoom &room : rooms_) room.clear();
    keeper_.keep(remains, progress_, count_);
    mesh_ = SolidMesh<m>(std::move(remains), job_);
    std::iota(left_.begin(), left_.end(), 0);
    blocks_ = SolidBlocks(left_.size(), job_.memory);
  }

  // ---- A collapse

  /// The cheapest admissible one of an edge of v within the limit. A vertex moves once a round.
  bool find(std::int32_t v, double limit, SolidWork<m> &work) {
    if (!mesh_.has_vertex(v) || progress_.moved[std::size_t(v)] == progress_.round) return false;
    const bool waits_itself = waits(v), is_known = waits_itself || costs_.is_known(cheapest(v));
    if (!is_known) costs_.find_cheapest(v, work.edges);
    if (!(cheapest(v).cost <= limit)) return false;
    work.done.within_limit++;
    if (waits_itself || waits(cheapest(v).other)) {
      work.done.waited++;
      return false;
    }
    work.collapse.met_sliver = false;
    if (is_admissible(v, cheapest(v), work.collapse)) return true;
    if (is_known) costs_.find_costs(v, work.edges);
    return find_dearer(v, limit, work);
  }

  bool waits(std::int32_t v) const { return !blocks_.is_inside(v); }

  /// The same among the edges that cost more than the cheapest, which is not admissible. work.edges: of v.
  bool find_dearer(std::int32_t v, double limit, SolidWork<m> &work) {
    Few<CheapestEdge, largest_cavity> dearer;
    const double tried = cheapest(v).cost;
    CheapestEdge later{infinity, 0, -1, stuck};
    for (std::size_t i = 0; i < work.edges.size(); i++) {
      const BestOfEdge &best = work.edges.costs[i];
      const CheapestEdge edge{best.cost, best.t, work.edges.neighbours.begin()[i], progress_.round};
      if (best.cost > tried && best.cost <= limit) dearer.push(edge);
      if (best.cost > limit && best.cost < later.cost) later = edge;
    }
    const auto is_cheaper = [](const CheapestEdge &a, const CheapestEdge &b) {
      return a.cost != b.cost ? a.cost < b.cost : a.other < b.other;
    };
    std::sort(dearer.begin(), dearer.end(), is_cheaper);
    for (const CheapestEdge &edge : dearer) {
      cheapest(v) = edge;
      if (waits(edge.other)) return false;
      if (is_admissible(v, edge, work.collapse)) return true;
    }
    cheapest(v) = later;
    work.done.refused++;
    work.done.slivers += work.collapse.met_sliver;
    return false;
  }

  bool is_admissible(std::int32_t v, const CheapestEdge &cheapest, SolidCollapse<m> &collapse) const {
    if (costs_.may_be_removed(v)) return places_.find_removal(v, cheapest.other, collapse);
    const bool may_widen = !options_.hasty || !progress_.removes();
    return places_.find(v, cheapest.other, cheapest.t, may_widen, collapse);
  }

  void make(const SolidCollapse<m> &collapse, SolidWork<m> &work, CollapseRoom &room) {
    const std::int32_t v = collapse.edge.stays;
    if (collapse.of_boundary) {
      if (limits_.are_passed(collapse.star, work.samples)) {
        costs_.find_cheapest(collapse.found_at, work.edges, cheapest(collapse.found_at).cost);
        return;
      }
      limits_.move_on(collapse.star, work.samples);
    }
    mesh_.collapse(collapse.edge, collapse.place, room);
    if (progress_.follows()) progress_.into[std::size_t(collapse.edge.gone)] = v;
    work.done.gone += std::int64_t(collapse.edge.tets_saved());
    work.done.collapses++;
    work.done.cost += cheapest(collapse.found_at).cost;
    progress_.moved[std::size_t(v)] = progress_.round;
    cheapest(v) = CheapestEdge();
    // What was not admissible around it may be so now.
    for (std::int32_t t : mesh_.tets_of.of(v))
      for (std::int32_t u : mesh_.tets[std::size_t(t)])
        if (cheapest(u).round == stuck) cheapest(u) = CheapestEdge();
    if (collapse.edge.is_widened()) costs_.forget_lost_edges(v, work.edges);
  }

  const MeshView &original_;
  TreeOnDemand &tree_;
  const FieldsAsLengths<m> &fields_;
  const SolidOptions &options_;
  Job &job_;
  SolidMesh<m> mesh_;
  SolidProgress progress_;
  SolidCosts<m> costs_;
  SolidPlaces<m> places_;
  StateKeeper<m> keeper_;
  std::int64_t count_;  // of the tets that are left
  SolidBlocks blocks_;
  Array<CollapseRoom> rooms_;  // of each block
  Array<SolidWork<m>> works_;
  BoundaryLimits limits_;
  Array<std::int32_t> left_;
};

}  // namespace

std::int64_t decimate_solid(const OriginalSolid &original, const SolidOptions &options, SolidHistory &history, Job &job,
                            TetMesh &mesh, Array<std::int32_t> &origin) {
  original.tree.drop();  // the memory is wanted
  return with_fields(original.mesh.fields, [&](auto m) {
    const FieldsAsLengths<m> fields(original.mesh, box_of(original.surface.points).diagonal(), job);
    CollapseStart<m> start = begin_collapses<m>(original.mesh, original.boundary, fields, options, history, job);
    const std::size_t saved = start.solid.measures.vertices - start.solid.points.size();
    const bool may_warm = start.progress.follows();
    SolidDecimator<m> decimator(original, options, fields, std::move(start),
                                start.keeps_states ? &history.states<m>(job.memory) : nullptr, job);
    decimator.run();
    decimator.write(mesh, origin);
    if (may_warm && !history.knows_usual_cost()) history.set_usual_cost(decimator.cost(), decimator.count());
    return std::int64_t(saved);
  });
}

}  // namespace tetlod
