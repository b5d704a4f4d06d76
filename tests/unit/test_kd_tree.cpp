// KdTree: every answer is that of looking at all items, whatever the leaves, also after items moved or went.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "kd_tree.hpp"

namespace tetlod {
namespace {

class KdTrees : public testing::TestWithParam<int> {
 protected:
  Memory memory;
  Parallel parallel{2};
  Job job{memory, parallel};
  std::mt19937_64 random{1};
  std::vector<Box> boxes;

  /// Corners on a lattice, so that boxes touch, coincide and tie; a lattice of 1000 hardly has any.
  Box random_box(int lattice, double size) {
    std::uniform_int_distribution<int> place(0, lattice);
    std::uniform_real_distribution<double> extent(0, size);
    Box box;
    const Vec3 low(place(random), place(random), place(random));
    box.add(low);
    box.add(low + glm::floor(Vec3(extent(random), extent(random), extent(random))));
    return box;
  }

  KdTree built() {
    KdTree tree(memory);
    Array<Box> copy(boxes.begin(), boxes.end(), &memory);
    tree.build(std::move(copy), GetParam(), job);
    return tree;
  }

  static bool touches(const Box &a, const Box &b) {
    for (int k = 0; k < 3; k++)
      if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    return true;
  }

  static double distance2_to(const Box &box, const Vec3 &p) {
    const Vec3 d = p - glm::clamp(p, box.low, box.high);
    return glm::dot(d, d);
  }

  static bool is_removed(const Box &box) { return box.low.x > box.high.x; }

  void expect_overlaps(const KdTree &tree, const Box &query) {
    std::multiset<std::int32_t> visited, expected;
    EXPECT_FALSE(tree.any_overlap(query, [&](std::int32_t item) {
      visited.insert(item);
      return false;
    }));
    for (std::size_t i = 0; i < boxes.size(); i++)
      if (touches(boxes[i], query)) expected.insert(std::int32_t(i));
    EXPECT_EQ(visited, expected);
    int calls = 0;
    EXPECT_EQ(tree.any_overlap(query, [&](std::int32_t) { return ++calls > 0; }), !expected.empty());
    EXPECT_LE(calls, 1) << "goes on after the visitor had enough";
  }

  /// `geometry`: what the items are, also those that were removed from the tree.
  void expect_nearest(const KdTree &tree, const Vec3 &p, const std::vector<Box> &geometry) {
    std::int32_t expected = -1;
    double least = std::numeric_limits<double>::infinity(), best = least;
    for (std::size_t i = 0; i < boxes.size(); i++)
      if (!is_removed(boxes[i]) && distance2_to(geometry[i], p) < least) {
        least = distance2_to(geometry[i], p);
        expected = std::int32_t(i);
      }
    const auto measure = [&](std::int32_t item) { return distance2_to(geometry[std::size_t(item)], p); };
    EXPECT_EQ(tree.nearest(p, best, measure), expected);
    EXPECT_EQ(best, least);
  }
  void expect_nearest(const KdTree &tree, const Vec3 &p) { expect_nearest(tree, p, boxes); }

  Vec3 random_place(double extent) {
    std::uniform_real_distribution<double> place(-0.2 * extent, 1.2 * extent);
    return {place(random), place(random), place(random)};
  }
};

INSTANTIATE_TEST_SUITE_P(Leaves, KdTrees, testing::Values(1, 8, 200));

TEST_P(KdTrees, FindOverlaps) {
  for (int lattice : {5, 1000})
    for (std::size_t count : {1u, 2u, 3u, 50u, 700u}) {
      boxes.clear();
      while (boxes.size() < count) boxes.push_back(random_box(lattice, 0.1 * lattice));
      const KdTree tree = built();
      for (int i = 0; i < 100; i++) expect_overlaps(tree, random_box(lattice, i % 2 ? lattice : 1));
      for (const double far : {1e9, std::numeric_limits<double>::infinity()})
        expect_overlaps(tree, {Vec3(-far), Vec3(far)});
      expect_overlaps(tree, {Vec3(2.0 * lattice), Vec3(3.0 * lattice)});
    }
}

TEST_P(KdTrees, FindTheNearest) {
  for (int lattice : {5, 1000})
    for (std::size_t count : {1u, 2u, 3u, 50u, 700u}) {
      boxes.clear();
      while (boxes.size() < count) boxes.push_back(random_box(lattice, 0.1 * lattice));
      const KdTree tree = built();
      for (int i = 0; i < 200; i++) expect_nearest(tree, random_place(lattice));
      for (int i = 0; i < 200; i++) expect_nearest(tree, glm::floor(random_place(lattice)));  // ties
    }
}

TEST_P(KdTrees, NearestWithinADistance) {
  boxes = {{Vec3(0), Vec3(1)}, {Vec3(4), Vec3(5)}};
  const KdTree tree = built();
  const auto measure = [&](std::int32_t item) { return distance2_to(boxes[std::size_t(item)], Vec3(2, 0.5, 0.5)); };
  double best = 0.99;
  EXPECT_EQ(tree.nearest(Vec3(2, 0.5, 0.5), best, measure), -1);
  EXPECT_EQ(best, 0.99);
  for (double most : {1.0, 1.01}) {
    best = most;
    EXPECT_EQ(tree.nearest(Vec3(2, 0.5, 0.5), best, measure), 0);
    EXPECT_EQ(best, 1);
  }
}

TEST_P(KdTrees, ItemsAllAtOnePlace) {
  boxes.assign(300, {Vec3(1), Vec3(2)});
  const KdTree tree = built();
  expect_overlaps(tree, {Vec3(2), Vec3(3)});
  expect_overlaps(tree, {Vec3(2.5), Vec3(3)});
  expect_nearest(tree, Vec3(5));
}

TEST_P(KdTrees, Empty) {
  const KdTree tree = built();
  EXPECT_TRUE(tree.empty());
  expect_overlaps(tree, {Vec3(-1e9), Vec3(1e9)});
  expect_nearest(tree, Vec3(0));
}

TEST_P(KdTrees, BoxOfAll) {
  Box all;
  while (boxes.size() < 100) {
    boxes.push_back(random_box(1000, 50));
    all.add(boxes.back());
  }
  const KdTree tree = built();
  EXPECT_EQ(tree.box().low, all.low);
  EXPECT_EQ(tree.box().high, all.high);
}

TEST_P(KdTrees, FollowMovingItems) {
  while (boxes.size() < 400) boxes.push_back(random_box(100, 10));
  KdTree tree = built();
  for (int round = 0; round < 20; round++) {
    for (int i = 0; i < 40; i++) {
      const std::size_t item = random() % boxes.size();
      boxes[item] = random_box(round < 10 ? 100 : 300, 10);
      tree.refit(std::int32_t(item), boxes[item]);
    }
    for (int i = 0; i < 20; i++) {
      expect_overlaps(tree, random_box(100, 30));
      expect_nearest(tree, random_place(100));
    }
  }
}

TEST_P(KdTrees, OverlapsForgetRemovedItems) {
  while (boxes.size() < 300) boxes.push_back(random_box(50, 10));
  KdTree tree = built();
  std::vector<std::size_t> order(boxes.size());
  for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (std::size_t item : order) {
    boxes[item] = Box();
    tree.refit(std::int32_t(item), Box());
    expect_overlaps(tree, random_box(50, 50));
  }
  expect_overlaps(tree, {Vec3(-1e9), Vec3(1e9)});
}

TEST_P(KdTrees, NearestForgetsRemovedItems) {
  while (boxes.size() < 300) boxes.push_back(random_box(50, 10));
  const std::vector<Box> geometry = boxes;
  KdTree tree = built();
  std::vector<std::size_t> order(boxes.size());
  for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (std::size_t item : order) {
    boxes[item] = Box();
    tree.refit(std::int32_t(item), Box());
    expect_nearest(tree, random_place(50), geometry);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace tetlod
