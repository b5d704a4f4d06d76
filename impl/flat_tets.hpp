// Tets of next to no volume in a mesh give way to others, with the tets around them.
#pragma once
#include "numbered_tets.hpp"
#include "tet_complex.hpp"

namespace tetlod {

class FlatTets : private TetComplex {
 public:
  /// Of these the others, which are turned upright; the boundary is none any more.
  FlatTets(NumberedTets &&solid, Job &job);

  MeshView view() const { return without_fields(points, tets); }
  std::size_t count() const { return tets.size(); }
  /// With the number of another.
  void add(const Tet &tet, std::int32_t beside);

  /// Tets around an edge of one give way with it to others around the same edge's ring, if these are sound: the best of
  /// such. One that cannot may when others around it have.
  void give_way();
  /// Those that are left may once tets around an edge nearby have. Those left at the boundary then go.
  void settle();

  /// After either: the triangles of the boundary, seen from outside, and whose they are.
  void find_outward_boundary(Array<Triangle> &triangles, Array<std::int32_t> &tet_of) const;
  /// Faces of theirs inside of the mesh, ascending.
  Array<Triangle> inner_faces() const;
  void give(NumberedTets &solid);

 private:
  /// The tet in one. Once it is gone, with another, there may be others in its slot.
  struct FlatTet {
    std::int32_t slot;
    Tet tet;
  };
  static constexpr std::size_t longest_ring = 8, most_fresh = 2 * (longest_ring - 2);
  using Ring = Few<std::int32_t, longest_ring>;
  /// Tets, what takes their place, and the numbers of these. Either may be what took the other's place.
  struct Way {
    Few<std::int32_t, most_fresh> old;
    Few<Tet, most_fresh> fresh;
    Few<std::int32_t, most_fresh> number;
  };

  bool is_gone(const FlatTet &flat) const { return tets[std::size_t(flat.slot)] != flat.tet; }
  void turn_upright();
  void peel();
  void drop_free_slots();
  template <class Goes>
  bool drop_if(const Goes &goes);
  bool gives_way(const FlatTet &flat);
  bool gives_way_after_another(const FlatTet &flat);
  bool gives_way_after(const Way &way, const FlatTet &flat);
  Array<std::int32_t> tets_around_edges(const FlatTet &flat) const;
  void take(const Way &way);
  void find_way(std::int32_t t, std::int32_t a, std::int32_t b, Way &best, double &best_shape2) const;
  Way way_around(const Ring &around, const Ring &ring, std::int32_t a, std::int32_t b, std::size_t apex) const;
  double worst_shape2(Span<const Tet> fresh) const;

  Job &job_;
  Array<std::int32_t> number_;  // of each tet, among the submitted ones
  Array<FlatTet> flat_;         // which have not given way
  Array<std::int32_t> made_;
  int tries_ = 0;  // of ways after others
};

}  // namespace tetlod
