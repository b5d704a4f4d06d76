// CGAL's Lindstrom-Turk edge collapse (GPL-3) alone, with its default cost and placement.
// usage: bench_cgal SURFACE EDGES
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "surface_file.hpp"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surface_from(const rivals::SurfaceFile &file) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const auto &p : file.points) vertices.push_back(surface.add_vertex({p[0], p[1], p[2]}));
  for (const auto &t : file.triangles) {
    const auto at = [&](std::size_t k) { return vertices[std::size_t(t[k])]; };
    if (surface.add_face(at(0), at(1), at(2)) == Surface::null_face()) {
      std::fprintf(stderr, "the surface is no manifold\n");
      std::exit(EXIT_FAILURE);
    }
  }
  return surface;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) return EXIT_FAILURE;
  Surface surface = surface_from(rivals::read_surface(argv[1]));
  const CGAL::Surface_mesh_simplification::Count_stop_predicate<Surface> stop(std::size_t(std::atoll(argv[2])));
  const rivals::Watch watch;
  CGAL::Surface_mesh_simplification::edge_collapse(surface, stop);
  watch.print(std::int64_t(surface.number_of_edges()));
}
