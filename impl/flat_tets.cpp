#include "flat_tets.hpp"

#include <algorithm>
#include <utility>

#include "predicates.hpp"

namespace tetlod {

namespace {

/// Each takes up to a millisecond.
constexpr int most_tries = 1000;

/// Whether the other, of the same vertices, has the winding of t.
bool winds_as(const Tet &t, const Tet &other) {
  int inversions = 0;
  std::size_t at[4];
  for (std::size_t i = 0; i < 4; i++) at[i] = std::size_t(std::find(t.begin(), t.end(), other[i]) - t.begin());
  for (std::size_t i = 0; i < 4; i++)
    for (std::size_t j = i + 1; j < 4; j++) inversions += at[i] > at[j];
  return inversions % 2 == 0;
}

/// visit(a, b) of each edge, until it returns true.
template <class Visit>
bool any_edge(const Tet &t, const Visit &visit) {
  for (std::size_t i = 0; i < 4; i++)
    for (std::size_t j = i + 1; j < 4; j++)
      if (visit(t[i], t[j])) return true;
  return false;
}

}  // namespace

FlatTets::FlatTets(NumberedTets &&solid, Job &job)
    : TetComplex(job.memory), job_(job), number_(std::move(solid.number)), flat_(&job.memory), made_(&job.memory) {
  points.assign(solid.points.begin(), solid.points.end());
  tets = std::move(solid.tets);
  turn_upright();
}

void FlatTets::add(const Tet &tet, std::int32_t beside) {
  flat_.push_back({std::int32_t(tets.size()), tet});
  tets.push_back(tet);
  number_.push_back(number_[std::size_t(beside)]);
}

void FlatTets::give_way() {
  find_neighbours(job_);
  while (drop_if([&](const FlatTet &flat) { return gives_way(flat); })) {
  }
  drop_free_slots();
}

void FlatTets::settle() {
  if (flat_.empty()) return;
  find_neighbours(job_);
  const auto goes = [&](const FlatTet &flat) { return gives_way(flat); };
  const auto goes_after = [&](const FlatTet &flat) { return gives_way_after_another(flat); };
  while (drop_if(goes) || drop_if(goes_after)) {
  }
  peel();
  drop_free_slots();
}

void FlatTets::find_outward_boundary(Array<Triangle> &triangles, Array<std::int32_t> &tet_of_triangle) const {
  triangles.clear();
  tet_of_triangle.clear();
  for (std::size_t t = 0; t < tets.size(); t++) {
    job_.poll_at(t, 0.9);
    for (std::size_t k = 0; k < 4; k++) {
      if (neighbours[t][k] >= 0) continue;
      triangles.push_back(face_opposite(tets[t], k));
      tet_of_triangle.push_back(std::int32_t(t));
    }
  }
}

Array<Triangle> FlatTets::inner_faces() const {
  Array<Triangle> faces(&job_.memory);
  for (const FlatTet &flat : flat_)
    for (int k = 0; k < 4; k++)
      if (neighbours[std::size_t(flat.slot)][std::size_t(k)] >= 0) faces.push_back(sorted_face(flat.tet, k));
  std::sort(faces.begin(), faces.end());
  return faces;
}

void FlatTets::give(NumberedTets &solid) {
  solid.tets = std::move(tets);
  solid.number = std::move(number_);
}

void FlatTets::turn_upright() {
  for (std::size_t t = 0; t < tets.size(); t++) {
    job_.poll_at(t, 0.9);
    if (orientation(points, tets[t]) < 0) std::swap(tets[t][2], tets[t][3]);
  }
}

/// The tets move up.
void FlatTets::drop_free_slots() {
  drop_if([&](const FlatTet &flat) { return is_gone(flat); });
  Array<std::int32_t> place(tets.size(), -1, &job_.memory);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < tets.size(); t++) {
    job_.poll_at(t, 0.9);
    if (!alive(std::int32_t(t))) continue;
    place[t] = std::int32_t(kept);
    tets[kept] = tets[t];
    number_[kept] = number_[t];
    neighbours[kept++] = neighbours[t];
  }
  tets.resize(kept);
  number_.resize(kept);
  neighbours.resize(kept);
  for (Tet &beyond : neighbours)
    for (std::int32_t &n : beyond)
      if (n >= 0) n = place[std::size_t(n)];
  for (FlatTet &flat : flat_) flat.slot = place[std::size_t(flat.slot)];
}

/// Those left at the boundary: there the sides have come to no end.
void FlatTets::peel() {
  for (bool any = true; any;) {
    any = false;
    for (const FlatTet &flat : flat_) {
      const Tet beyond = is_gone(flat) ? Tet{} : neighbours[std::size_t(flat.slot)];
      if (*std::min_element(beyond.begin(), beyond.end()) >= 0) continue;
      for (const std::int32_t n : beyond)
        if (n >= 0) std::replace(neighbours[std::size_t(n)].begin(), neighbours[std::size_t(n)].end(), flat.slot, -1);
      tets[std::size_t(flat.slot)][0] = -1;
      any = true;
    }
  }
}

/// Whether some do.
template <class Goes>
bool FlatTets::drop_if(const Goes &goes) {
  const auto end = std::remove_if(flat_.begin(), flat_.end(), goes);
  const bool any = end != flat_.end();
  flat_.erase(end, flat_.end());
  return any;
}

bool FlatTets::gives_way(const FlatTet &flat) {
  job_.poll(0.9);
  if (is_gone(flat)) return true;
  Way best;
  double best_shape2 = least_shape * least_shape;
  any_edge(flat.tet, [&](std::int32_t a, std::int32_t b) {
    find_way(flat.slot, a, b, best, best_shape2);
    return false;
  });
  if (!best.fresh.empty()) take(best);
  return !best.fresh.empty();
}

/// Once tets around an edge nearby have.
bool FlatTets::gives_way_after_another(const FlatTet &flat) {
  if (is_gone(flat)) return true;
  if (tries_++ >= most_tries) return false;
  const Array<std::int32_t> around = tets_around_edges(flat);
  return std::any_of(around.begin(), around.end(), [&](std::int32_t t) {
    return any_edge(Tet(tets[std::size_t(t)]), [&](std::int32_t a, std::int32_t b) {
      Way way;
      double shape2 = least_shape * least_shape;
      find_way(t, a, b, way, shape2);
      return !way.fresh.empty() && !way.old.has(flat.slot) && gives_way_after(way, flat);
    });
  });
}

/// If it does not, all is as it was, each tet in its slot.
bool FlatTets::gives_way_after(const Way &way, const FlatTet &flat) {
  Way back;
  for (const std::int32_t t : way.old) {
    back.fresh.push(tets[std::size_t(t)]);
    back.number.push(number_[std::size_t(t)]);
  }
  take(way);
  for (const std::int32_t t : made_) back.old.push(t);
  if (gives_way(flat)) return true;
  take(back);
  return false;
}

Array<std::int32_t> FlatTets::tets_around_edges(const FlatTet &flat) const {
  Array<std::int32_t> all(&job_.memory);
  any_edge(flat.tet, [&](std::int32_t a, std::int32_t b) {
    Ring around, ring;
    if (TetComplex::ring(flat.slot, a, b, around, ring, [](std::int32_t) { return true; }))
      all.insert(all.end(), around.begin(), around.end());
    return false;
  });
  return all;
}

void FlatTets::take(const Way &way) {
  replace_tets(way.old, way.fresh, made_);
  number_.resize(tets.size());
  for (std::size_t i = 0; i < made_.size(); i++) number_[std::size_t(made_[i])] = way.number[i];
}

/// A better one without the edge (a, b) of tet t: the one whose worst tet has the best shape.
void FlatTets::find_way(std::int32_t t, std::int32_t a, std::int32_t b, Way &best, double &best_shape2) const {
  Ring around, ring;
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
FlatTets::Way FlatTets::way_around(const Ring &around, const Ring &ring, std::int32_t a, std::int32_t b,
                                   std::size_t apex) const {
  Way way;
  for (const std::int32_t t : around) way.old.push(t);
  way.fresh = fan(ring, a, b, apex);
  for (std::size_t i = 0; i < way.fresh.size(); i++)
    way.number.push(number_[std::size_t(around[(apex + 1 + i / 2) % ring.size()])]);
  return way;
}

/// 0 if one is not positive.
double FlatTets::worst_shape2(Span<const Tet> fresh) const {
  double worst = 1;
  for (const Tet &t : fresh) {
    const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
    const bool is_positive = six_volume(points, t) > 0;
    worst = std::min(worst, is_positive ? shape2(at(0), at(1), at(2), at(3)) : 0);
  }
  return worst;
}

}  // namespace tetlod
