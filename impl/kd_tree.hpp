// A k-d tree over things that have a box: triangles and tets. Every node keeps the box of what is below it, so the
// tree answers overlap and nearest queries, and can follow things that move a little (refit).
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "box_pair.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

/// box_of_item(i) of each of `count`.
template <class BoxOfItem>
Array<Box> boxes_of(std::size_t count, Job &job, const BoxOfItem &box_of_item) {
  Array<Box> boxes = array_of(count, Box(), job);
  for_each(count, job, [&](std::size_t i) { boxes[i] = box_of_item(i); });
  return boxes;
}

class KdTree {
 public:
  explicit KdTree(Memory &memory)
      : nodes_(&memory), leaves_(&memory), boxes_(&memory), items_(&memory), leaf_of_(&memory) {}

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
    nodes_.clear();
    leaves_.clear();
    boxes_.clear();
    items_.clear();
    leaf_of_.clear();
    box_ = Box();
    grow(leaf_of_, of_items.size(), job, -1);
    if (entries.empty()) return;
    const Counts counts = counts_of(std::int32_t(entries.size())).first;
    grow(nodes_, std::size_t(counts.nodes), job);
    grow(leaves_, std::size_t(counts.nodes + 1), job);
    grow(boxes_, std::size_t(counts.pairs), job, BoxPair::empty());
    grow(items_, 2 * std::size_t(counts.pairs), job, -1);
    box_ = split(of_items, {entries.data(), entries.size()}, {}, -1, job, fraction);
  }

  /// Anew, of what is left in it.
  void rebuild(Job &job) {
    Array<Box> of_items(leaf_of_.size(), Box(), boxes_.get_allocator());
    for (std::size_t i = 0; i < items_.size(); i++)
      if (items_[i] >= 0) of_items[std::size_t(items_[i])] = boxes_[i / 2].get(int(i % 2));
    build(std::move(of_items), leaf_, job, 0.5);
  }

  bool empty() const { return leaves_.empty(); }
  const Box &box() const { return box_; }

  /// visit(item) for every item whose box overlaps; stops when visit returns true, and says whether it did.
  template <class Visit>
  bool any_overlap(const Box &box, const Visit &visit) const {
    // A box without end overlaps an empty one, too.
    const auto stops_at = [&](std::size_t i) { return items_[i] >= 0 && visit(items_[i]); };
    std::int32_t stack[max_depth];
    int top = 0;
    if (!empty() && overlap(box_, box)) stack[top++] = root();
    while (top) {
      const std::int32_t self = stack[--top];
      if (self >= 0) {
        const Node &node = nodes_[std::size_t(self)];
        const BoxPair::Which half = node.halves.overlapping(box);
        if (half.second) stack[top++] = node.child[1];
        if (half.first) stack[top++] = node.child[0];
        continue;
      }
      const Leaf &leaf = leaves_[std::size_t(~self)];
      for (std::int32_t i = leaf.begin; i < leaf.end; i++) {
        const BoxPair::Which item = boxes_[std::size_t(i)].overlapping(box);
        if (item.first && stops_at(2 * std::size_t(i))) return true;
        if (item.second && stops_at(2 * std::size_t(i) + 1)) return true;
      }
    }
    return false;
  }

  /// The item with the least distance2_to(item), searched nearest box first; -1 when the tree is empty or all are
  /// farther than sqrt(best). `best` becomes the squared distance of what is found. Ties go to the lower item.
  template <class Distance2>
  std::int32_t nearest(const Vec3 &p, double &best, const Distance2 &distance2_to) const {
    std::int32_t found = -1;
    struct {
      std::int32_t self;
      double distance2;
    } stack[max_depth];
    int top = 0;
    if (!empty()) stack[top++] = {root(), distance2(box_, p)};
    while (top) {
      auto [self, waiting2] = stack[--top];
      while (reaches(waiting2, best) && self >= 0) {
        const Node &node = nodes_[std::size_t(self)];
        const BoxPair::Both of_halves = node.halves.distances2(p);
        const int nearer = of_halves[1] <= of_halves[0];
        if (reaches(of_halves[1 - nearer], best)) stack[top++] = {node.child[1 - nearer], of_halves[1 - nearer]};
        self = node.child[nearer], waiting2 = of_halves[nearer];
      }
      if (!reaches(waiting2, best)) continue;
      const Leaf &leaf = leaves_[std::size_t(~self)];
      for (std::int32_t i = leaf.begin; i < leaf.end; i++) {
        const BoxPair::Both of_items = boxes_[std::size_t(i)].distances2(p);
        for (int k = 0; k < 2; k++)
          if (reaches(of_items[k], best)) take_if_nearer(items_[std::size_t(2 * i + k)], distance2_to, best, found);
      }
    }
    return found;
  }

  /// Gives an item another box (an empty one removes it from every answer) and mends the boxes above it.
  void refit(std::int32_t item, const Box &box) {
    const Leaf &leaf = leaves_[std::size_t(leaf_of_[std::size_t(item)])];
    const auto at = std::size_t(std::find(items_.begin() + 2 * leaf.begin, items_.end(), item) - items_.begin());
    boxes_[at / 2].set(int(at % 2), box);
    Box mended = box_of_leaf(leaf);
    std::int32_t self = ~leaf_of_[std::size_t(item)], above = leaf.parent;
    for (; above >= 0; self = std::exchange(above, nodes_[std::size_t(above)].parent)) {
      Node &node = nodes_[std::size_t(above)];
      const int half = node.child[1] == self;
      const Box old = node.halves.get(half);
      if (mended.low == old.low && mended.high == old.high) return;
      node.halves.set(half, mended);
      mended = node.halves.whole();
    }
    box_ = mended;
  }

 private:
  static constexpr int max_depth = 128;  // twice the depth of 2^32 items halved, and more

  struct Node {
    BoxPair halves;
    std::int32_t child[2];  // below 0: ~ is a leaf
    std::int32_t parent;
  };
  struct Leaf {
    std::int32_t begin, end;  // of boxes_
    std::int32_t parent;
  };
  struct Entry {
    Vec3 centre;  // twice
    std::int32_t item;
  };
  /// There is one leaf more than nodes.
  struct Counts {
    std::int32_t nodes = 0, pairs = 0;
    Counts operator+(const Counts &o) const { return {nodes + o.nodes, pairs + o.pairs}; }
  };

  std::int32_t root() const { return nodes_.empty() ? ~0 : 0; }

  /// An empty box is infinitely far, and out of reach even when nothing was found yet.
  static bool reaches(double box_distance2, double best) {
    return box_distance2 <= best && box_distance2 < BoxPair::infinity;
  }

  template <class Distance2>
  static void take_if_nearer(std::int32_t item, const Distance2 &distance2_to, double &best, std::int32_t &found) {
    const double d = distance2_to(item);
    if (!(d < best || (d == best && (found < 0 || item < found)))) return;
    best = d;
    found = item;
  }

  Box box_of_leaf(const Leaf &leaf) const {
    Box box;
    for (std::int32_t i = leaf.begin; i < leaf.end; i++) box.add(boxes_[std::size_t(i)].whole());
    return box;
  }

  static Counts counts_of_leaf(std::int32_t items) { return {0, (items + 1) / 2}; }
  /// Of the trees of so many items, and of one more.
  std::pair<Counts, Counts> counts_of(std::int32_t items) const {
    const Counts node{1, 0}, leaf = counts_of_leaf(items);
    if (items < leaf_) return {leaf, counts_of_leaf(items + 1)};
    if (items == leaf_) return {leaf, node + counts_of_leaf((items + 1) / 2) + counts_of_leaf((items + 2) / 2)};
    const auto [half, more] = counts_of(items / 2);
    return items % 2 ? std::pair(node + half + more, node + more + more)
                     : std::pair(node + half + half, node + half + more);
  }

  /// Where what is below something begins.
  struct Place {
    std::int32_t node = 0, leaf = 0, pair = 0;
  };

  Box fill_leaf(const Array<Box> &of_items, Span<Entry> entries, const Place &at, std::int32_t parent) {
    // By their numbers: in which order halve() leaves them is a matter of the standard library.
    std::sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) { return a.item < b.item; });
    leaves_[std::size_t(at.leaf)] = {at.pair, at.pair + std::int32_t(entries.size() + 1) / 2, parent};
    for (std::size_t i = 0; i < entries.size(); i++) {
      const std::int32_t item = entries[i].item;
      items_[2 * std::size_t(at.pair) + i] = item;
      boxes_[std::size_t(at.pair) + i / 2].set(int(i % 2), of_items[std::size_t(item)]);
      leaf_of_[std::size_t(item)] = at.leaf;
    }
    return box_of_leaf(leaves_[std::size_t(at.leaf)]);
  }

  static void halve(Span<Entry> entries) {
    Box centres;
    for (const Entry &entry : entries) centres.add(entry.centre);
    const int axis = centres.longest_axis();
    const auto half = entries.begin() + entries.size() / 2;
    std::nth_element(entries.begin(), half, entries.end(), [axis](const Entry &a, const Entry &b) {
      const double at = glm::value_ptr(a.centre)[axis], other_at = glm::value_ptr(b.centre)[axis];
      return (at < other_at) | ((at == other_at) & (a.item < b.item));
    });
  }

  /// Into nodes and leaves from there on; their box.
  Box split(const Array<Box> &of_items, Span<Entry> entries, const Place &at, std::int32_t parent, Job &job,
            double fraction) {
    constexpr std::size_t few = 1024, many = 8192;
    if (entries.size() > few) job.poll(fraction);
    const auto is_leaf = [&](Span<Entry> some) { return some.size() <= std::size_t(leaf_); };
    if (is_leaf(entries)) return fill_leaf(of_items, entries, at, parent);
    halve(entries);
    const std::size_t half = entries.size() / 2;
    const Span<Entry> halves[] = {{entries.data(), half}, {entries.data() + half, entries.size() - half}};
    const Counts first = counts_of(std::int32_t(half)).first;
    const Place places[] = {{at.node + 1, at.leaf, at.pair},
                            {at.node + 1 + first.nodes, at.leaf + first.nodes + 1, at.pair + first.pairs}};
    Node &node = nodes_[std::size_t(at.node)];
    node.parent = parent;
    Box boxes[2];
    const auto split_half = [&](std::size_t i, std::size_t) {
      node.child[i] = is_leaf(halves[i]) ? ~places[i].leaf : places[i].node;
      boxes[i] = split(of_items, halves[i], places[i], at.node, job, fraction);
    };
    if (entries.size() > many) {
      job.parallel.for_blocks(2, 1, split_half);
    } else {
      split_half(0, 1);
      split_half(1, 2);
    }
    for (int i = 0; i < 2; i++) node.halves.set(i, boxes[i]);
    return node.halves.whole();
  }

  Array<Node> nodes_;
  Array<Leaf> leaves_;
  Array<BoxPair> boxes_;       // leaf by leaf; of an odd number the last one is empty
  Array<std::int32_t> items_;  // two of each pair
  Array<std::int32_t> leaf_of_;
  Box box_;
  std::int32_t leaf_ = 1;
};

}  // namespace tetlod
