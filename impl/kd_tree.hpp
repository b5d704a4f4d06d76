// A k-d tree over things that have a box: triangles and tets. Every node keeps the box of what is below it, so the
// tree answers overlap and nearest queries, and can follow things that move a little (refit).
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>

#include "whole_arrays.hpp"

namespace tetlod {

inline bool overlap(const Box &a, const Box &b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// box_of_item(i) of each of `count`.
template <class BoxOfItem>
Array<Box> boxes_of(std::size_t count, Job &job, const BoxOfItem &box_of_item) {
  Array<Box> boxes = array_of(count, Box(), job);
  for_each(count, job, [&](std::size_t i) { boxes[i] = box_of_item(i); });
  return boxes;
}

class KdTree {
 public:
  explicit KdTree(Memory &memory) : boxes_(&memory), items_(&memory), nodes_(&memory), leaf_of_(&memory) {}

  /// Splits at the median of the boxes' centres along the longest extent, until at most `leaf` items are left. What has
  /// an empty box is in no answer.
  void build(Array<Box> &&boxes, std::int64_t leaf, Job &job, double fraction = 0) {
    const Array<Box> of_items = std::move(boxes);
    leaf_ = std::int32_t(std::max<std::int64_t>(leaf, 1));
    Array<Entry> entries(&job.memory);
    entries.reserve(of_items.size());
    for (std::size_t i = 0; i < of_items.size(); i++) {
      job.poll_at(i, fraction);
      if (of_items[i].low.x <= of_items[i].high.x)
        entries.push_back({of_items[i].low + of_items[i].high, std::int32_t(i)});
    }
    leaf_of_.clear();
    items_.clear();
    boxes_.clear();
    nodes_.clear();
    grow(leaf_of_, of_items.size(), job, -1);
    grow(items_, entries.size(), job);
    grow(boxes_, entries.size(), job);
    if (entries.empty()) return;
    grow(nodes_, std::size_t(nodes_below(std::int32_t(entries.size())).first), job);
    split(of_items, {entries.data(), entries.size()}, 0, 0, -1, job, fraction);
  }

  /// Anew, of what is left in it.
  void rebuild(Job &job) {
    Array<Box> of_items(leaf_of_.size(), Box(), boxes_.get_allocator());
    for (std::size_t i = 0; i < boxes_.size(); i++) of_items[std::size_t(items_[i])] = boxes_[i];
    build(std::move(of_items), leaf_, job, 0.5);
  }

  bool empty() const { return nodes_.empty(); }
  const Box &box() const { return nodes_[0].box; }

  /// visit(item) for every item whose box overlaps; stops when visit returns true, and says whether it did.
  template <class Visit>
  bool any_overlap(const Box &box, const Visit &visit) const {
    std::int32_t stack[max_depth];
    int top = 0;
    if (!nodes_.empty()) stack[top++] = 0;
    while (top) {
      const std::int32_t self = stack[--top];
      const Node &node = nodes_[std::size_t(self)];
      if (!overlap(node.box, box)) continue;
      if (node.right) {
        stack[top++] = node.right;
        stack[top++] = self + 1;
        continue;
      }
      for (std::int32_t i = node.begin; i < node.end; i++)
        if (overlap(boxes_[std::size_t(i)], box) && visit(items_[std::size_t(i)])) return true;
    }
    return false;
  }

  /// The item with the least distance2_to(item), searched nearest box first; -1 when the tree is empty or all are
  /// farther than sqrt(best). `best` becomes the squared distance of what is found. Ties go to the lower item.
  template <class Distance2>
  std::int32_t nearest(const Vec3 &p, double &best, const Distance2 &distance2_to) const {
    std::int32_t found = -1;
    struct {
      std::int32_t node;
      double distance2;
    } stack[max_depth];
    int top = 0;
    const auto push = [&](std::int32_t node, double distance2) {
      if (reaches(distance2, best)) stack[top++] = {node, distance2};
    };
    if (!nodes_.empty()) push(0, distance2(nodes_[0].box, p));
    while (top) {
      auto [self, waiting2] = stack[--top];
      while (reaches(waiting2, best) && nodes_[std::size_t(self)].right) {
        std::int32_t other = nodes_[std::size_t(self)].right;
        double other2 = distance2(nodes_[std::size_t(other)].box, p);
        self++, waiting2 = distance2(nodes_[std::size_t(self)].box, p);
        if (other2 <= waiting2) std::swap(self, other), std::swap(waiting2, other2);
        push(other, other2);
      }
      if (!reaches(waiting2, best)) continue;
      const Node &node = nodes_[std::size_t(self)];
      for (std::int32_t i = node.begin; i < node.end; i++) {
        if (!reaches(distance2(boxes_[std::size_t(i)], p), best)) continue;
        const std::int32_t item = items_[std::size_t(i)];
        const double d = distance2_to(item);
        if (d < best || (d == best && (found < 0 || item < found))) {
          best = d;
          found = item;
        }
      }
    }
    return found;
  }

  /// Gives an item another box (an empty one removes it from every answer) and mends the boxes above it.
  void refit(std::int32_t item, const Box &box) {
    const Node &leaf = nodes_[std::size_t(leaf_of_[std::size_t(item)])];
    const auto at = std::find(items_.begin() + leaf.begin, items_.begin() + leaf.end, item);
    boxes_[std::size_t(at - items_.begin())] = box;
    for (std::int32_t self = leaf_of_[std::size_t(item)]; self >= 0; self = nodes_[std::size_t(self)].parent) {
      const Box mended = box_below(self);
      Box &old = nodes_[std::size_t(self)].box;
      if (mended.low == old.low && mended.high == old.high) break;
      old = mended;
    }
  }

 private:
  static constexpr int max_depth = 128;  // twice the depth of 2^32 items halved, and more

  struct Node {
    Box box;
    std::int32_t begin, end;  // items, of a leaf
    std::int32_t right;       // 0: a leaf; the left child is the next node
    std::int32_t parent;
  };

  /// An empty box is infinitely far, and out of reach even when nothing was found yet.
  static bool reaches(double box_distance2, double best) {
    return box_distance2 <= best && box_distance2 < std::numeric_limits<double>::infinity();
  }

  Box box_below(std::int32_t self) const {
    const Node &node = nodes_[std::size_t(self)];
    Box box;
    if (node.right) {
      box.add(nodes_[std::size_t(self + 1)].box);
      box.add(nodes_[std::size_t(node.right)].box);
    } else {
      for (std::int32_t i = node.begin; i < node.end; i++) box.add(boxes_[std::size_t(i)]);
    }
    return box;
  }

  struct Entry {
    Vec3 centre;  // twice
    std::int32_t item;
  };

  /// Of the trees of so many items, and of one more.
  std::pair<std::int32_t, std::int32_t> nodes_below(std::int32_t items) const {
    if (items < leaf_) return {1, 1};
    if (items == leaf_) return {1, 3};
    const auto [half, more] = nodes_below(items / 2);
    return items % 2 ? std::pair(1 + half + more, 1 + 2 * more) : std::pair(1 + 2 * half, 1 + half + more);
  }

  /// Those from `begin` on become the node `self`, and what is below it.
  void split(const Array<Box> &of_items, Span<Entry> entries, std::int32_t begin, std::int32_t self,
             std::int32_t parent, Job &job, double fraction) {
    constexpr std::size_t few = 1024, many = 8192;
    if (entries.size() > few) job.poll(fraction);
    const auto size = std::int32_t(entries.size());
    Node &node = nodes_[std::size_t(self)];
    node = {Box(), begin, begin + size, 0, parent};
    if (size <= leaf_) {
      for (std::int32_t i = 0; i < size; i++) {
        const std::int32_t item = entries[std::size_t(i)].item;
        items_[std::size_t(begin + i)] = item;
        boxes_[std::size_t(begin + i)] = of_items[std::size_t(item)];
        leaf_of_[std::size_t(item)] = self;
      }
    } else {
      const std::int32_t half = size / 2;
      Box centres;
      for (const Entry &entry : entries) centres.add(entry.centre);
      const int axis = centres.longest_axis();
      std::nth_element(entries.begin(), entries.begin() + half, entries.end(), [axis](const Entry &a, const Entry &b) {
        const double at = glm::value_ptr(a.centre)[axis], other_at = glm::value_ptr(b.centre)[axis];
        return (at < other_at) | ((at == other_at) & (a.item < b.item));
      });
      node.right = self + 1 + nodes_below(half).first;
      const auto split_half = [&](std::size_t right, std::size_t) {
        if (right)
          split(of_items, {entries.data() + half, std::size_t(size - half)}, begin + half, node.right, self, job,
                fraction);
        else
          split(of_items, {entries.data(), std::size_t(half)}, begin, self + 1, self, job, fraction);
      };
      if (entries.size() > many) {
        job.parallel.for_blocks(2, 1, split_half);
      } else {
        split_half(0, 1);
        split_half(1, 2);
      }
    }
    node.box = box_below(self);
  }

  Array<Box> boxes_;           // of items_
  Array<std::int32_t> items_;  // leaf by leaf
  Array<Node> nodes_;
  Array<std::int32_t> leaf_of_;
  std::int32_t leaf_ = 1;
};

}  // namespace tetlod
