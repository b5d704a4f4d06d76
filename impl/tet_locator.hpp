// Which tet of a mesh whose connectivity changes holds a point.
#pragma once
#include <algorithm>

#include "geometry.hpp"
#include "kd_tree.hpp"
#include "tet_complex.hpp"

namespace tetlod {

/// Finds tets by walking, and where the walk meets the boundary, by a tree. For as long as the mesh stays as it is.
class TetLocator {
 public:
  TetLocator(const TetComplex &mesh, Job &job);

  /// The tet of p, searched from tet `hint` on, or, where that is -1, from anywhere; -1 outside.
  std::int32_t find(const Vec3 &p, std::int32_t hint) const;
  /// Of the tets that counts() is true of.
  template <class Counts>
  std::int32_t find_among(const Vec3 &p, const Counts &counts) const;

  /// How many of the tree's items hold a place in the box of all, on the average: what a search costs where a walk does
  /// not do.
  double items_at_a_place() const { return items_at_a_place_; }

 private:
  Array<Box> boxes_of_items(Job &job);
  template <class Visit>
  void for_tets(std::size_t item, const Visit &visit) const;
  std::int32_t walk(const Vec3 &p, std::int32_t t) const;

  const TetComplex &mesh_;
  std::int32_t start_ = 0;
  Array<TetFrame> frames_;
  Array<std::int32_t> order_;  ///< of the tets
  std::size_t together_;       ///< how many of these, one after another, are one item of the tree
  double items_at_a_place_;
  KdTree tree_;
};

/// Of an item, until visit says no.
template <class Visit>
void TetLocator::for_tets(std::size_t item, const Visit &visit) const {
  const std::size_t end = std::min((item + 1) * together_, order_.size());
  for (std::size_t i = item * together_; i < end; i++)
    if (mesh_.alive(order_[i]) && !visit(order_[i])) return;
}

template <class Counts>
std::int32_t TetLocator::find_among(const Vec3 &p, const Counts &counts) const {
  double best = -out_by_rounding;
  std::int32_t found = -1;
  tree_.any_overlap({p, p}, [&](std::int32_t item) {
    for_tets(std::size_t(item), [&](std::int32_t t) {
      if (!counts(t)) return true;
      double w[4];
      const double least = frames_[std::size_t(t)].weights(p, w);
      if (least > best) {
        best = least;
        found = t;
      }
      return best < 0;
    });
    return best >= 0;
  });
  return found;
}

}  // namespace tetlod
