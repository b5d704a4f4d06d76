// Walks around the vertices of a surface of half-edges (OpenMesh's).
#pragma once

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

}  // namespace tetlod
