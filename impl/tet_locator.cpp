#include "tet_locator.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "sort_by_place.hpp"

namespace tetlod {

namespace {

constexpr std::int64_t leaf = 16;
constexpr int longest_walk = 200;
/// Of items. Where there are more some tets are in order, and others, inserted one after another, anywhere: the items
/// of these reach far.
constexpr double most_at_a_place = 32;

/// Of many tets, few points go down the tree.
std::size_t tets_an_item(std::size_t tets) {
  constexpr std::size_t most_items = 20000, most = 1024;
  std::size_t together = 1;
  while (together < most && tets > together * most_items) together *= 2;
  return together;
}

/// Of places in the box of all, on the average.
double boxes_at_a_place(Span<const Box> boxes) {
  const auto volume = [](const Box &box) {
    const Vec3 extent = box.high - box.low;
    return extent.x * extent.y * extent.z;
  };
  Box whole;
  double sum = 0;
  for (const Box &box : boxes) {
    whole.add(box);
    if (box.low.x <= box.high.x) sum += volume(box);
  }
  return sum / volume(whole);
}

}  // namespace

TetLocator::TetLocator(const TetComplex &mesh, Job &job)
    : mesh_(mesh),
      frames_(&job.memory),
      order_(&job.memory),
      together_(tets_an_item(mesh.tets.size())),
      tree_(job.memory) {
  while (!mesh.alive(start_)) start_++;
  grow(frames_, mesh.tets.size(), job);
  for_each(mesh.tets.size(), job, [&](std::size_t t) {
    if (mesh.alive(std::int32_t(t))) frames_[t] = mesh.frame(std::int32_t(t));
  });
  const auto place = [&](std::size_t t) { return mesh.points[std::size_t(mesh.tets[t][1])]; };  // of free slots, too
  order_ = order_in_space(mesh.tets.size(), place, job);
  Array<Box> boxes = boxes_of_items(job);
  if (together_ > 1 && items_at_a_place_ > most_at_a_place) {
    order_ = order_by_place(mesh.tets.size(), place, job);
    boxes = boxes_of_items(job);
  }
  tree_.build(std::move(boxes), leaf, job, 0.1);
}

std::int32_t TetLocator::find(const Vec3 &p, std::int32_t hint) const {
  const std::int32_t t = walk(p, hint >= 0 ? hint : start_);
  return t >= 0 ? t : find_among(p, [](std::int32_t) { return true; });
}

/// And how many of them hold a place.
Array<Box> TetLocator::boxes_of_items(Job &job) {
  Array<Box> boxes = boxes_of(order_.size() / together_ + 1, job, [&](std::size_t item) {
    Box box;
    for_tets(item, [&](std::int32_t t) {
      box.add(with_rounding(box_of<4>(mesh_.points, mesh_.tets[std::size_t(t)])));
      return true;
    });
    return box;
  });
  items_at_a_place_ = boxes_at_a_place(boxes);
  return boxes;
}

std::int32_t TetLocator::walk(const Vec3 &p, std::int32_t t) const {
  for (int step = 0; step < longest_walk; step++) {
    double w[4];
    if (frames_[std::size_t(t)].is_flat()) return -1;
    const double least = frames_[std::size_t(t)].weights(p, w);
    if (least >= 0) return t;
    const std::int32_t next = mesh_.neighbours[std::size_t(t)][std::size_t(std::min_element(w, w + 4) - w)];
    if (next < 0) return least >= -out_by_rounding ? t : -1;
    t = next;
  }
  return -1;
}

}  // namespace tetlod
