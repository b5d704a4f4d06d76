// 3.2  What placement needs of the ends of an edge: sums over the triangles and the neighbours of each vertex.
#pragma once
#include "collapse_rules.hpp"
#include "half_edges.hpp"
#include "lindstrom_turk.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

/// A hub has so many neighbours that no edge of it may collapse (longest_ring). Its sums are not kept up to date, which
/// would take time for each collapse beside it.
class VertexSums {
 public:
  explicit VertexSums(Memory &memory) : volume_(&memory), link_(&memory) {}

  void resize(std::size_t vertices, Job &job) {
    grow(volume_, vertices, job);
    grow(link_, vertices, job);
  }

  /// Anew. plane(h), point(h): of the triangle, and of the other end, of a half-edge that leaves v.
  template <class Mesh, class Vertex, class Plane, class Point>
  void update(const Mesh &mesh, Vertex v, const Plane &plane, const Point &point) {
    VolumeSums volume;
    LinkSums link;
    for_each_around(mesh, v, [&](auto h) {
      volume.add(plane(h));
      link.add(point(h));
    });
    volume_[std::size_t(v.idx())] = volume;
    link_[std::size_t(v.idx())] = link;
  }

  /// After a collapse beside it, which takes one of its neighbours at most. False: it is none, or may be none any more.
  bool stays_hub(int v) {
    if (!is_hub(v)) return false;
    link_[std::size_t(v)].count--;
    return is_hub(v);
  }
  /// An edge to a vertex of three neighbours, the fewest, has one neighbour less.
  bool is_hub(int v) const { return neighbours(v) > double(longest_ring + 1); }
  /// Of a hub, at least.
  double neighbours(int v) const { return link_[std::size_t(v)].count; }

  VolumeSums volume(int from, int to) const { return sum(volume_, from, to); }
  LinkSums link(int from, int to) const { return sum(link_, from, to); }

 private:
  template <class Sums>
  static Sums sum(const Array<Sums> &of, int from, int to) {
    Sums both = of[std::size_t(from)];
    both.add(of[std::size_t(to)]);
    return both;
  }

  Array<VolumeSums> volume_;
  Array<LinkSums> link_;
};

}  // namespace tetlod
