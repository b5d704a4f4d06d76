// GTS (LGPL-2) alone: the boundary decimated by gts_surface_coarsen, as the paper used it, volume and shape weighted.
// usage: bench_gts SURFACE EDGES
#include <gts.h>

#include "surface_file.hpp"

namespace {

GtsSurface *surface_from(const rivals::SurfaceFile &file) {
  GtsSurface *const surface =
      gts_surface_new(gts_surface_class(), gts_face_class(), gts_edge_class(), gts_vertex_class());
  std::vector<GtsVertex *> vertices;
  for (const auto &p : file.points) vertices.push_back(gts_vertex_new(gts_vertex_class(), p[0], p[1], p[2]));
  const auto edge = [&](std::int32_t from, std::int32_t to) {
    GtsVertex *const a = vertices[std::size_t(from)], *const b = vertices[std::size_t(to)];
    GtsSegment *const known = gts_vertices_are_connected(a, b);
    return known != nullptr ? GTS_EDGE(known) : gts_edge_new(gts_edge_class(), a, b);
  };
  for (const auto &t : file.triangles) {
    GtsEdge *const e0 = edge(t[0], t[1]), *const e1 = edge(t[1], t[2]), *const e2 = edge(t[2], t[0]);
    gts_surface_add_face(surface, gts_face_new(gts_face_class(), e0, e1, e2));
  }
  return surface;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) return EXIT_FAILURE;
  GtsSurface *const surface = surface_from(rivals::read_surface(argv[1]));
  GtsVolumeOptimizedParams weights{1.0, 1.0, 0.1};
  guint edges = guint(std::atoll(argv[2]));
  const double least_fold = 3.14159265358979323846 / 180;  // what the program `coarsen` has
  const rivals::Watch watch;
  gts_surface_coarsen(surface, reinterpret_cast<GtsKeyFunc>(gts_volume_optimized_cost), &weights,
                      reinterpret_cast<GtsCoarsenFunc>(gts_volume_optimized_vertex), &weights,
                      reinterpret_cast<GtsStopFunc>(gts_coarsen_stop_number), &edges, least_fold);
  watch.print(gts_surface_edge_number(surface));
}
