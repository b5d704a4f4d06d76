// A closed surface of half-edges (OpenMesh's, which one file includes): walks around its vertices, the collapse of its
// edges.
#pragma once
#include "surface_topology.hpp"

namespace tetlod {

/// The next half-edge that leaves the same vertex, counter-clockwise.
template <class Mesh, class Halfedge>
Halfedge next_around(const Mesh &mesh, Halfedge h) {
  return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
}

/// The half-edges that leave v; stops when visit returns true, and says whether it did.
template <class Mesh, class Vertex, class Visit>
bool any_around(const Mesh &mesh, Vertex v, const Visit &visit) {
  const auto first = mesh.halfedge_handle(v);
  auto h = first;
  do {
    if (visit(h)) return true;
    h = next_around(mesh, h);
  } while (h != first);
  return false;
}

template <class Mesh, class Vertex, class Visit>
void for_each_around(const Mesh &mesh, Vertex v, const Visit &visit) {
  any_around(mesh, v, [&](auto h) {
    visit(h);
    return false;
  });
}

/// The corner of a half-edge's triangle that it does not touch.
template <class Mesh, class Halfedge>
auto apex(const Mesh &mesh, Halfedge h) {
  return mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
}

/// Of the cut surface, straight from the mates: OpenMesh's add_face would search and, on what it does not like, print.
template <class Mesh>
void copy_connectivity(const SurfaceTopology &topology, Job &job, Mesh &mesh) {
  const std::size_t halfedges = topology.mate.size(), triangles = halfedges / 3;
  const auto vertex = [&](std::size_t h) { return typename Mesh::VertexHandle(topology.sheet_vertex[h]); };
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.reserve(topology.vertex_of.size(), halfedges / 2, triangles);
  for (std::size_t v = 0; v < topology.vertex_of.size(); v++) mesh.new_vertex();
  Array<typename Mesh::HalfedgeHandle> made(halfedges, typename Mesh::HalfedgeHandle(), &job.memory);
  for (std::size_t h = 0; h < halfedges; h++) {
    job.poll_at(h, 0);
    const auto mate = std::size_t(topology.mate[h]);
    if (mate < h) continue;
    made[h] = mesh.new_edge(vertex(h), vertex(mate));
    made[mate] = mesh.opposite_halfedge_handle(made[h]);
  }
  for (std::size_t t = 0; t < triangles; t++) {
    job.poll_at(t, 0);
    const auto face = mesh.new_face();
    for (std::size_t k = 0; k < 3; k++) {
      const std::size_t h = 3 * t + k;
      mesh.set_face_handle(made[h], face);
      mesh.set_next_halfedge_handle(made[h], made[3 * t + (k + 1) % 3]);
      mesh.set_halfedge_handle(vertex(h), made[h]);
    }
    mesh.set_halfedge_handle(face, made[3 * t]);
  }
}

/// Of the triangle of h, whose edge collapses, `kept` is one of the other two half-edges: it takes the place of the one
/// beyond the third, whose edge is deleted, as the triangle is.
template <class Mesh, class Halfedge>
void close_triangle(Halfedge h, Halfedge kept, Mesh &mesh) {
  const Halfedge next = mesh.next_halfedge_handle(h), third = kept == next ? mesh.prev_halfedge_handle(h) : next;
  const Halfedge beyond = mesh.opposite_halfedge_handle(third), mate = mesh.opposite_halfedge_handle(kept);
  const auto face = mesh.face_handle(beyond);
  mesh.status(mesh.face_handle(h)).set_deleted(true);
  mesh.status(mesh.edge_handle(third)).set_deleted(true);
  mesh.set_next_halfedge_handle(kept, mesh.next_halfedge_handle(beyond));
  mesh.set_next_halfedge_handle(mesh.prev_halfedge_handle(beyond), kept);
  mesh.set_face_handle(kept, face);
  if (mesh.halfedge_handle(face) == beyond) mesh.set_halfedge_handle(face, kept);
  mesh.set_halfedge_handle(mesh.to_vertex_handle(kept), mate);
  mesh.set_halfedge_handle(mesh.to_vertex_handle(mate), kept);
}

/// The start of h becomes its end. What OpenMesh's own leaves, which is for polygons and boundaries, too, and takes
/// several times as long.
template <class Mesh, class Halfedge>
void collapse_edge(Halfedge h, Mesh &mesh) {
  const Halfedge o = mesh.opposite_halfedge_handle(h);
  const auto from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
  for_each_around(mesh, from, [&](Halfedge out) { mesh.set_vertex_handle(mesh.opposite_halfedge_handle(out), to); });
  close_triangle(h, mesh.next_halfedge_handle(h), mesh);
  close_triangle(o, mesh.prev_halfedge_handle(o), mesh);
  mesh.set_isolated(from);
  mesh.status(mesh.edge_handle(h)).set_deleted(true);
}

}  // namespace tetlod
