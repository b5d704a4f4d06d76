#include "close_quads.hpp"

#include <algorithm>
#include <utility>

#include "flat_layers.hpp"
#include "predicates.hpp"
#include "tet_complex.hpp"

namespace tetlod {

namespace {

constexpr std::size_t longest_ring = 8, most_fresh = 2 * (longest_ring - 2);
/// Few quads are left after a few rounds, but where tets overlap. A try takes up to a millisecond.
constexpr int most_rounds = 20, most_tries = 1000;

/// Tets, what takes their place, and the numbers of these.
struct Way {
  Few<std::int32_t, most_fresh> old;
  Few<Tet, most_fresh> fresh;
  Few<std::int32_t, most_fresh> number;
};

/// Whether the order of a, b, c, d is one of those that have the winding of t.
bool winds_as(const Tet &t, const Tet &other) {
  int inversions = 0;
  std::size_t at[4];
  for (std::size_t i = 0; i < 4; i++) at[i] = std::size_t(std::find(t.begin(), t.end(), other[i]) - t.begin());
  for (std::size_t i = 0; i < 4; i++)
    for (std::size_t j = i + 1; j < 4; j++) inversions += at[i] > at[j];
  return inversions % 2 == 0;
}

class ClosedQuads : private TetComplex {
 public:
  /// From `first` on tets are flat, and wind as they fit.
  ClosedQuads(NumberedTets &&solid, std::size_t first, Job &job)
      : TetComplex(job.memory), job_(job), number_(std::move(solid.number)), quads_(&job.memory), made_(&job.memory) {
    points.assign(solid.points.begin(), solid.points.end());
    tets = std::move(solid.tets);
    turn_upright(first);
    for (std::size_t t = first; t < tets.size(); t++) quads_.push_back({std::int32_t(t), tets[t]});
    connect(job);
  }

  /// One that does not may when others around it have.
  void let_quads_give_way() {
    const auto some_go = [&](const auto &goes) {
      const auto end = std::remove_if(quads_.begin(), quads_.end(), goes);
      const bool any = end != quads_.end();
      quads_.erase(end, quads_.end());
      return any;
    };
    for (int round = 0; round < most_rounds; round++)
      if (!some_go([&](const Quad &quad) { return gives_way(quad); }) &&
          !some_go([&](const Quad &quad) { return gives_way_after_another(quad); }))
        return;
  }

  void give(NumberedTets &solid) {
    peel();
    solid.tets.clear();
    solid.number.clear();
    for (std::size_t t = 0; t < tets.size(); t++) {
      job_.poll_at(t, 0.9);
      if (!alive(std::int32_t(t))) continue;
      solid.tets.push_back(tets[t]);
      solid.number.push_back(number_[t]);
    }
  }

 private:
  void turn_upright(std::size_t tets_with_volume) {
    for (std::size_t t = 0; t < tets_with_volume; t++) {
      job_.poll_at(t, 0.9);
      const auto at = [&](std::size_t k) { return points[std::size_t(tets[t][k])]; };
      if (orientation(at(0), at(1), at(2), at(3)) < 0) std::swap(tets[t][2], tets[t][3]);
    }
  }

  /// Flat tets at the boundary are left out: there the sides have come to no end.
  void peel() {
    for (bool any = true; any;) {
      any = false;
      for (const Quad &quad : quads_) {
        Tet &beyond = neighbours[std::size_t(quad.slot)];
        if (is_gone(quad) || *std::min_element(beyond.begin(), beyond.end()) >= 0) continue;
        for (const std::int32_t n : beyond)
          if (n >= 0) std::replace(neighbours[std::size_t(n)].begin(), neighbours[std::size_t(n)].end(), quad.slot, -1);
        tets[std::size_t(quad.slot)][0] = -1;
        any = true;
      }
    }
  }

  /// The tet in one. Once it is gone, with another, there may be others in its slot.
  struct Quad {
    std::int32_t slot;
    Tet tet;
  };
  bool is_gone(const Quad &quad) const { return tets[std::size_t(quad.slot)] != quad.tet; }

  /// visit(a, b) of each edge, until it returns true.
  template <class Visit>
  static bool any_edge(const Tet &t, const Visit &visit) {
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = i + 1; j < 4; j++)
        if (visit(t[i], t[j])) return true;
    return false;
  }

  bool gives_way(const Quad &quad) {
    job_.poll(0.9);
    if (is_gone(quad)) return true;
    Way best;
    double best_shape2 = least_shape * least_shape;
    any_edge(quad.tet, [&](std::int32_t a, std::int32_t b) {
      find_way(quad.slot, a, b, best, best_shape2);
      return false;
    });
    if (!best.fresh.empty()) take(best);
    return !best.fresh.empty();
  }

  /// Once tets around an edge nearby have.
  bool gives_way_after_another(const Quad &quad) {
    if (is_gone(quad)) return true;
    if (tries_++ >= most_tries) return false;
    const Array<std::int32_t> around = tets_around_edges(quad);
    return std::any_of(around.begin(), around.end(), [&](std::int32_t t) {
      return any_edge(Tet(tets[std::size_t(t)]), [&](std::int32_t a, std::int32_t b) {
        Way way;
        double shape2 = least_shape * least_shape;
        find_way(t, a, b, way, shape2);
        return !way.fresh.empty() && !way.old.has(quad.slot) && gives_way_after(way, quad);
      });
    });
  }

  /// If it does not, all is as it was, each tet in its slot.
  bool gives_way_after(const Way &way, const Quad &quad) {
    Way back;
    for (const std::int32_t t : way.old) {
      back.fresh.push(tets[std::size_t(t)]);
      back.number.push(number_[std::size_t(t)]);
    }
    take(way);
    for (const std::int32_t t : made_) back.old.push(t);
    if (gives_way(quad)) return true;
    take(back);
    return false;
  }

  Array<std::int32_t> tets_around_edges(const Quad &quad) const {
    Array<std::int32_t> all(&job_.memory);
    any_edge(quad.tet, [&](std::int32_t a, std::int32_t b) {
      Few<std::int32_t, longest_ring> around, ring;
      if (TetComplex::ring(quad.slot, a, b, around, ring, [](std::int32_t) { return true; }))
        all.insert(all.end(), around.begin(), around.end());
      return false;
    });
    return all;
  }

  void take(const Way &way) {
    replace_tets(way.old, way.fresh, made_);
    number_.resize(tets.size());
    for (std::size_t i = 0; i < made_.size(); i++) number_[std::size_t(made_[i])] = way.number[i];
  }

  /// A better one without the edge (a, b) of tet t: the one whose worst tet has the best shape.
  void find_way(std::int32_t t, std::int32_t a, std::int32_t b, Way &best, double &best_shape2) const {
    Few<std::int32_t, longest_ring> around, ring;
    if (!TetComplex::ring(t, a, b, around, ring, [](std::int32_t) { return true; }) || ring.size() < 3) return;
    if (!winds_as(tets[std::size_t(t)], {a, b, ring[0], ring[1]})) std::swap(a, b);  // t is flat
    for (std::size_t apex = 0; apex < ring.size(); apex++) {
      const Way way = way_around(around, ring, a, b, apex);
      const double shape2 = worst_shape2(way.fresh);
      if (!(shape2 > best_shape2)) continue;
      best = way;
      best_shape2 = shape2;
    }
  }

  /// Of the two tets at a triangle of the ring's fan the numbers are those of the tet at its edge that is the ring's.
  Way way_around(const Few<std::int32_t, longest_ring> &around, const Few<std::int32_t, longest_ring> &ring,
                 std::int32_t a, std::int32_t b, std::size_t apex) const {
    Way way;
    for (const std::int32_t t : around) way.old.push(t);
    way.fresh = fan(ring, a, b, apex);
    for (std::size_t i = 0; i < way.fresh.size(); i++)
      way.number.push(number_[std::size_t(around[(apex + 1 + i / 2) % ring.size()])]);
    return way;
  }

  /// 0 if one is not positive.
  double worst_shape2(Span<const Tet> fresh) const {
    double worst = 1;
    for (const Tet &t : fresh) {
      const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
      const bool is_positive = det(at(0), at(1), at(2), at(3)) > 0;
      worst = std::min(worst, is_positive ? shape2(at(0), at(1), at(2), at(3)) : 0);
    }
    return worst;
  }

  Job &job_;
  Array<std::int32_t> number_;  // of each tet, among the submitted ones
  Array<Quad> quads_;           // whose tets have not given way
  Array<std::int32_t> made_;
  int tries_ = 0;  // of ways after others
};

}  // namespace

bool close_crossed_quads(Job &job, NumberedTets &solid) {
  const std::size_t first = solid.tets.size();
  if (!add_flat_layers(job, solid)) return false;
  if (first == solid.tets.size()) return true;
  ClosedQuads closed(std::move(solid), first, job);
  closed.let_quads_give_way();
  closed.give(solid);
  return true;
}

}  // namespace tetlod
