#include "decimate_solid.hpp"

#include <limits>
#include <optional>

#include "deviation.hpp"
#include "solid_blocks.hpp"
#include "solid_mesh.hpp"
#include "solid_rules.hpp"

namespace tetlod {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Part of the vertices whose cheapest edges a round looks at. A smaller one comes nearer to the cheapest edge of all
/// first, and loses no less.
constexpr double part_of_round = 0.33;
/// Tets that a collapse takes away, about.
constexpr double tets_a_collapse = 5.5;
/// Where nothing is lost, short edges first: what the square of a length counts as.
constexpr double shape_share = 1e-6;
/// Of the volume, that the boundary may lose.
constexpr double volume_to_lose = 0.01;
/// A best place further off than this part of the edge is none.
constexpr double longest_step = 0.5;

template <std::size_t m>
struct SolidCollapse {
  explicit SolidCollapse(Memory &memory) : star(memory) {}
  SolidEdge edge;
  Vector<3 + m> place{};
  std::int32_t found_at = -1;  ///< the end whose cheapest edge it is
  bool of_boundary = false;
  Star star;  ///< of the boundary
};

template <std::size_t m>
class SolidDecimator {
 public:
  SolidDecimator(const MeshView &original, const Boundary &boundary, const Surface &surface,
                 const SolidOptions &options, Job &job)
      : original_(original),
        range_(range_of(original)),
        scales_(scales_of(original, box_of(surface.points).diagonal(), range_)),
        job_(job),
        mesh_(put_in_order(original, boundary, job), original.values<m>(), scales_, job),
        count_(std::int64_t(mesh_.tets.size())),
        blocks_(mesh_.points.size(), job.memory),
        rooms_(&job.memory),
        works_(&job.memory),
        cheapest_(mesh_.points.size(), CheapestEdge(), &job.memory),
        moved_(mesh_.points.size(), -1, &job.memory),
        left_(&job.memory),
        changed_(&job.memory) {
    for (std::size_t i = 0; i < mesh_.points.size(); i++) {
      const auto v = std::int32_t(i);
      const auto flagged = [&](Span<const std::uint8_t> flags) {
        return !flags.empty() && flags[std::size_t(mesh_.origin[i])];
      };
      if (flagged(options.kept)) mesh_.ranks[i] = mesh_.on_boundary(v) ? Rank::kept_boundary : Rank::kept_inner;
      if (flagged(options.touching)) mesh_.ranks[i] = Rank::touching;
      left_.push_back(v);
    }
    rooms_.reserve(SolidBlocks::most);
    works_.reserve(SolidBlocks::most);
    for (std::size_t b = 0; b < SolidBlocks::most; b++) {
      rooms_.emplace_back(job.memory);
      works_.emplace_back(job.memory);
    }
    volume_of_collapse_ = volume_to_lose * mesh_.volume() / double(surface.points.size());
    if (options.max_deviation > 0) deviation_.emplace(surface, options.max_deviation, job);
  }

  void run(std::int64_t target) {
    const double surplus = double(count_ - target);
    find_cheapest_edges(left_);
    for (double limit; count_ > target && (limit = limit_of_round(target)) < infinity;) {
      job_.poll(1 - double(count_ - target) / surplus);
      collapse_some(limit, target);
      mesh_.tidy({rooms_.data(), rooms_.size()});
      drop_gone(left_);
      drop_gone(changed_);
      round_++;
      find_cheapest_edges(changed_);
    }
  }

  void write(TetMesh &out, Array<std::int32_t> &origin) const {
    Array<std::int32_t> known(original_.points.size(), -1, &job_.memory), number(mesh_.points.size(), -1, &job_.memory);
    for (std::int32_t v : left_) known[std::size_t(mesh_.origin[std::size_t(v)])] = v;
    for (std::size_t i = 0; i < known.size(); i++) {
      const std::int32_t v = known[i];
      if (v < 0) continue;
      const bool moved = mesh_.point(v) != original_.points[i];
      number[std::size_t(v)] = std::int32_t(out.points.size());
      out.points.push_back(mesh_.point(v));
      const Values<m> values = moved ? values_of(v) : original_.values<m>()[i];
      out.scalars.insert(out.scalars.end(), values.begin(), values.end());
      origin.push_back(moved ? -1 : std::int32_t(i));
    }
    job_.poll(1);
    const auto append = [&](const auto &simplices, auto &to) {
      for (auto simplex : simplices) {
        if (simplex[0] < 0) continue;
        for (std::int32_t &v : simplex) v = number[std::size_t(v)];
        to.push_back(simplex);
      }
    };
    append(mesh_.tets, out.tets);
    append(mesh_.triangles, out.boundary);
  }

 private:
  /// No admissible edge of the vertex costs less, as far as was known in that round.
  struct CheapestEdge {
    double cost = infinity, t = 0;
    std::int32_t other = -1;
    int round = -1;
  };

  /// Rounds of a vertex none of whose edges is admissible, and of one that is looked at again after the round.
  static constexpr int stuck = -2, waiting = -3;

  using Place = Vector<3 + m>;

  /// What a block does in a round.
  struct Work {
    explicit Work(Memory &memory) : items(&memory), changed(&memory), collapse(memory) {}
    Array<std::int32_t> items, changed;
    SolidCollapse<m> collapse;
    std::int64_t most = 0, gone = 0;  ///< tets
  };

  /// Of the values that tets have: other points' mean nothing.
  static ValueRange<m> range_of(const MeshView &original) {
    const Span<const Values<m>> values = original.values<m>();
    ValueRange<m> range;
    for (const Tet &t : original.tets)
      for (std::int32_t v : t) range.add(values[std::size_t(v)]);
    return range;
  }

  /// A field's range counts as the diagonal, where its weight is 1; the first may be constant.
  static Values<m> scales_of(const MeshView &original, double diagonal, const ValueRange<m> &range) {
    double half = 0;  // the whole may be more than a double holds
    for (std::size_t i = 0; i < m && !(half > 0); i++)
      half = original.scales.relative[i] * (0.5 * range.high[i] - 0.5 * range.low[i]);
    const double scale = half > 0 ? 0.5 * diagonal / half : 1;
    Values<m> scales;
    for (std::size_t i = 0; i < m; i++) scales[i] = scale * original.scales.weighted[i];
    return scales;
  }

  Values<m> values_of(std::int32_t v) const {
    Values<m> values;
    for (std::size_t i = 0; i < m; i++) values[i] = mesh_.vertex(v).place[3 + i] / scales_[i];
    return range_.clamp(values);
  }

  CheapestEdge &cheapest(std::int32_t v) { return cheapest_[std::size_t(v)]; }
  const CheapestEdge &cheapest(std::int32_t v) const { return cheapest_[std::size_t(v)]; }

  // ---- Costs

  struct Ends {
    std::int32_t stays, gone;
  };
  Ends ends_of(std::int32_t v, std::int32_t u) const { return mesh_.rank(v) < mesh_.rank(u) ? Ends{u, v} : Ends{v, u}; }
  bool keeps_place(std::int32_t stays, std::int32_t gone) const { return mesh_.rank(stays) != mesh_.rank(gone); }
  bool may_go(std::int32_t v) const { return mesh_.rank(v) == Rank::inner || mesh_.rank(v) == Rank::boundary; }

  BestOfEdge cost(std::int32_t v, std::int32_t u) const {
    const auto [stays, gone] = ends_of(v, u);
    if (!may_go(gone) || mesh_.rank(stays) == Rank::touching) return {0, infinity};
    const auto &a = mesh_.vertex(stays), &b = mesh_.vertex(gone);
    const Place d = minus(b.place, a.place);
    BestOfEdge best = best_of_edge(a.quadric, b.quadric, d, keeps_place(stays, gone));
    constexpr std::size_t tets = entry_of(3, 3);
    best.cost += shape_share * length2(point_of(d)) * (a.quadric.a[tets] + b.quadric.a[tets]);
    return best;
  }

  /// An edge is looked at from one end, the one that moved last.
  bool owns(std::int32_t v, std::int32_t u) const {
    const int at = moved_[std::size_t(v)], other_at = moved_[std::size_t(u)];
    return at != other_at ? at > other_at : v < u;
  }

  void find_cheapest_edge(std::int32_t v, double more_than) {
    CheapestEdge found;
    found.round = round_;
    for (std::int32_t u : mesh_.neighbours.of(v)) {
      if (!owns(v, u)) continue;
      const BestOfEdge best = cost(v, u);
      if (best.cost > more_than && best.cost < found.cost) found = {best.cost, best.t, u, round_};
    }
    cheapest(v) = found;
  }

  void find_cheapest_edges(Span<const std::int32_t> vertices) {
    job_.parallel.for_blocks(vertices.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i++) find_cheapest_edge(vertices[i], -infinity);
      job_.poll(0);
    });
  }

  /// Its other end may have moved or gone since.
  bool is_known(const CheapestEdge &edge) const {
    return edge.other >= 0 && mesh_.has_vertex(edge.other) && moved_[std::size_t(edge.other)] < edge.round;
  }

  // ---- Rounds

  /// What an edge of the round may cost. Towards the end rounds get smaller, so that the last collapses are the
  /// cheapest.
  double limit_of_round(std::int64_t target) const {
    Array<double> costs(&job_.memory);
    for (std::int32_t v : left_)
      if (cheapest(v).cost < infinity) costs.push_back(cheapest(v).cost);
    if (costs.empty()) return infinity;
    const double needed = 1 + double(count_ - target) / tets_a_collapse;
    const double wanted = std::min(part_of_round * double(left_.size()), needed);
    const auto last = costs.begin() + std::ptrdiff_t(std::min(std::size_t(wanted), costs.size() - 1));
    std::nth_element(costs.begin(), last, costs.end());
    return *last;
  }

  void collapse_some(double limit, std::int64_t target) {
    Array<std::int32_t> items(&job_.memory);
    for (std::int32_t v : left_)
      if (cheapest(v).cost <= limit) items.push_back(v);
    blocks_.cut(mesh_, left_, round_, most_blocks(items.size()), job_);
    for (std::int32_t v : items) works_[blocks_.of(v)].items.push_back(v);
    const double share = double(count_ - target) / double(items.size());
    job_.parallel.for_blocks(blocks_.count(), 1, [&](std::size_t b, std::size_t) {
      Work &work = works_[b];
      work.most = std::int64_t(std::ceil(share * double(work.items.size())));
      collapse_in_block(limit, work, rooms_[b]);
    });
    take_over(items.size());
  }

  /// Few are soon done; what bounds the deviation is one for all; and where most wait, one block gets on.
  std::size_t most_blocks(std::size_t items) const {
    constexpr std::size_t few = 256;
    return items < few || deviation_ || most_waited_ ? 1 : SolidBlocks::most;
  }

  void collapse_in_block(double limit, Work &work, CollapseRoom &room) {
    for (std::size_t i = 0; i < work.items.size() && work.gone < work.most; i++) {
      if (i % 64 == 0) job_.poll(0);
      if (find(work.items[i], limit, work.collapse)) make(work.collapse, work, room);
    }
  }

  void take_over(std::size_t items) {
    changed_.clear();
    for (Work &work : works_) {
      count_ -= work.gone;
      changed_.insert(changed_.end(), work.changed.begin(), work.changed.end());
      work.items.clear();
      work.changed.clear();
      work.gone = 0;
    }
    most_waited_ = blocks_.count() > 1 && changed_.size() * 8 < items;
  }

  void drop_gone(Array<std::int32_t> &vertices) const {
    const auto is_gone = [&](std::int32_t v) { return !mesh_.has_vertex(v); };
    vertices.erase(std::remove_if(vertices.begin(), vertices.end(), is_gone), vertices.end());
  }

  // ---- A collapse

  /// The cheapest admissible one of an edge of v within the limit. A vertex moves once a round.
  bool find(std::int32_t v, double limit, SolidCollapse<m> &collapse) {
    if (!mesh_.has_vertex(v) || moved_[std::size_t(v)] == round_ || waits(v)) return false;
    if (!is_known(cheapest(v))) find_cheapest_edge(v, -infinity);
    if (!(cheapest(v).cost <= limit) || waits(cheapest(v).other)) return false;
    return is_admissible(v, cheapest(v), collapse) || find_dearer(v, limit, collapse);
  }

  bool waits(std::int32_t v) const { return !blocks_.is_inside(mesh_, v); }

  /// The same among the edges that cost more than the cheapest, which is not admissible.
  bool find_dearer(std::int32_t v, double limit, SolidCollapse<m> &collapse) {
    Few<CheapestEdge, largest_cavity> dearer;
    const double tried = cheapest(v).cost;
    CheapestEdge later;
    later.round = stuck;
    for (std::int32_t u : mesh_.neighbours.of(v)) {
      if (!owns(v, u)) continue;
      const BestOfEdge best = cost(v, u);
      if (best.cost > tried && best.cost <= limit) dearer.push({best.cost, best.t, u, round_});
      if (best.cost > limit && best.cost < later.cost) later = {best.cost, best.t, u, round_};
    }
    const auto is_cheaper = [](const CheapestEdge &a, const CheapestEdge &b) {
      return a.cost != b.cost ? a.cost < b.cost : a.other < b.other;
    };
    std::sort(dearer.begin(), dearer.end(), is_cheaper);
    for (const CheapestEdge &edge : dearer) {
      cheapest(v) = edge;
      if (waits(edge.other)) return false;
      if (is_admissible(v, edge, collapse)) return true;
    }
    cheapest(v) = later;
    return false;
  }

  bool is_admissible(std::int32_t v, const CheapestEdge &cheapest, SolidCollapse<m> &collapse) {
    const auto [stays, gone] = ends_of(v, cheapest.other);
    collapse.found_at = v;
    if (!look_around(mesh_, stays, gone, collapse.edge)) return false;
    collapse.of_boundary = mesh_.on_boundary(gone);
    return find_place(cheapest.t, collapse) && !breaks_topology(mesh_, collapse.edge);
  }

  /// The best place near the edge, or, where that is none, the best along it.
  bool find_place(double t, SolidCollapse<m> &collapse) {
    const SolidEdge &edge = collapse.edge;
    const auto &stays = mesh_.vertex(edge.stays), &gone = mesh_.vertex(edge.gone);
    const Place d = minus(gone.place, stays.place), best = along(stays.place, t, d);
    StepConstraint constraint;
    if (collapse.of_boundary) constraint = keeping_volume(mesh_, edge, point_of(best));
    if (!keeps_place(edge.stays, edge.gone)) {
      LocalQuadric<3 + m> sum = stays.quadric.moved(minus(best, stays.place));
      sum.add(gone.quadric.moved(minus(best, gone.place)));
      Place step;
      if (step_to_least(sum, constraint, step) && is_short(step, d) && suits(along(best, 1, step), collapse))
        return true;
    }
    return std::abs(constraint.offset) / 6 <= volume_of_collapse_ && suits(best, collapse);
  }

  static bool is_short(const Place &step, const Place &edge) {
    return length2(point_of(step)) <= longest_step * longest_step * length2(point_of(edge));
  }

  bool suits(const Place &place, SolidCollapse<m> &collapse) {
    const Vec3 point = point_of(place);
    collapse.place = place;
    if (flattens(mesh_, collapse.edge, point)) return false;
    if (!collapse.of_boundary) return true;
    Star &star = collapse.star;
    return look_around_on_boundary(mesh_, collapse.edge, point, star) && !turns_too_far(star) && !folds(star) &&
           !makes_sliver(star);
  }

  void make(const SolidCollapse<m> &collapse, Work &work, CollapseRoom &room) {
    const std::int32_t v = collapse.edge.stays;
    if (deviation_ && collapse.of_boundary) {
      if (deviation_->is_passed(collapse.star)) {
        find_cheapest_edge(collapse.found_at, cheapest(collapse.found_at).cost);
        return;
      }
      deviation_->move_on(collapse.star);
    }
    mesh_.collapse(collapse.edge, collapse.place, room);
    work.gone += std::int64_t(collapse.edge.edge_tets.size());
    moved_[std::size_t(v)] = round_;
    work.changed.push_back(v);
    // What was not admissible around it may be so now.
    for (std::int32_t u : mesh_.neighbours.of(v))
      if (cheapest(u).round == stuck) {
        cheapest(u).round = waiting;
        work.changed.push_back(u);
      }
  }

  const MeshView &original_;
  ValueRange<m> range_;
  Values<m> scales_;  // length that a unit of each field counts as
  Job &job_;
  SolidMesh<m> mesh_;
  std::int64_t count_;  // of the tets that are left
  SolidBlocks blocks_;
  Array<CollapseRoom> rooms_;  // of each block
  Array<Work> works_;
  bool most_waited_ = false;
  std::optional<DeviationLimit> deviation_;
  double volume_of_collapse_ = 0;
  int round_ = 0;
  Array<CheapestEdge> cheapest_;
  Array<int> moved_;  // the round in which each vertex moved last
  Array<std::int32_t> left_, changed_;
};

}  // namespace

void decimate_solid(const MeshView &original, const Boundary &boundary, const Surface &surface,
                    const SolidOptions &options, Job &job, TetMesh &mesh, Array<std::int32_t> &origin) {
  with_fields(original.fields, [&](auto m) {
    SolidDecimator<m> decimator(original, boundary, surface, options, job);
    decimator.run(options.tets);
    decimator.write(mesh, origin);
  });
}

}  // namespace tetlod
