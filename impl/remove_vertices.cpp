#include "remove_vertices.hpp"

#include "sweep.hpp"

namespace tetlod {

namespace {

/// Stars with more error than so many prices have no vertex to spare.
constexpr double busy = 20;

struct VertexRemoval {
  std::int32_t vertex;
  Cavity old;  ///< the star of the vertex that goes
  Filling fresh;
};

/// Looks for the collapse of a vertex that costs least; of the mesh as it is.
template <std::size_t m>
class CollapseFinder {
 public:
  CollapseFinder(double price, const AdaptiveMesh<m> &mesh) : price_(price), mesh_(mesh) {}

  bool find(std::int32_t v, VertexRemoval &collapse) const {
    if (mesh_.tet_of[std::size_t(v)] < 0 || !mesh_.star(v, collapse.old)) return false;
    collapse.vertex = v;
    const double old_error = mesh_.error_of(collapse.old);
    if (old_error > busy * price_) return false;
    Cavity link;
    for (std::int32_t t : collapse.old)
      for (std::int32_t u : mesh_.tets[std::size_t(t)])
        if (u != v && !link.has(u)) link.push(u);
    double best = 0;
    bool found = false;
    for (std::int32_t u : link) {
      const Filling fresh = moved_to(v, u, collapse.old);
      if (!mesh_.is_better(collapse.old, fresh, price_, old_error, best)) continue;
      collapse.fresh = fresh;
      found = true;
    }
    return found;
  }

 private:
  Filling moved_to(std::int32_t v, std::int32_t u, const Cavity &star) const {
    Filling fresh;
    for (std::int32_t t : star) {
      Tet tet = mesh_.tets[std::size_t(t)];
      if (std::find(tet.begin(), tet.end(), u) != tet.end()) continue;
      *std::find(tet.begin(), tet.end(), v) = u;
      fresh.push(tet);
    }
    return fresh;
  }

  double price_;
  const AdaptiveMesh<m> &mesh_;
};

}  // namespace

template <std::size_t m>
void remove_vertices(double price, Job &job, AdaptiveMesh<m> &mesh) {
  Array<std::int32_t> items(&job.memory), made(&job.memory);
  for (std::size_t v = 0; v < mesh.points.size(); v++)
    if (!mesh.fixed[v] && !mesh.kept[v] && mesh.tet_of[v] >= 0) items.push_back(std::int32_t(v));
  const CollapseFinder finder(price, mesh);
  const Array<std::size_t> batches =
      batches_apart(mesh, StarLists(Span<const Tet>(mesh.tets), mesh.points.size(), job), job, items);
  sweep<VertexRemoval>(
      items, batches, job, mesh, [&](std::int32_t v, VertexRemoval &collapse) { return finder.find(v, collapse); },
      [&](const VertexRemoval &collapse) {
        mesh.replace(collapse.old, collapse.fresh, made);
        mesh.tet_of[std::size_t(collapse.vertex)] = -1;
      });
}

template void remove_vertices(double, Job &, AdaptiveMesh<1> &);
template void remove_vertices(double, Job &, AdaptiveMesh<2> &);
template void remove_vertices(double, Job &, AdaptiveMesh<3> &);
template void remove_vertices(double, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
