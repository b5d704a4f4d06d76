// SPDX-License-Identifier: AGPL-3.0-or-later
// TetGen (AGPL-3) alone: a boundary and samples tetrahedralized, with the switches that tetlod-remesh is first given.
// usage: bench_tetgen SURFACE
#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>

#include "surface_file.hpp"

int main(int argc, char **argv) {
  if (argc != 2) return EXIT_FAILURE;
  rivals::SurfaceFile surface = rivals::read_surface(argv[1]);
  std::vector<tetgenio::polygon> polygons(surface.triangles.size());
  std::vector<tetgenio::facet> facets(surface.triangles.size());
  for (std::size_t i = 0; i < facets.size(); i++) {
    polygons[i] = {surface.triangles[i].data(), 3};
    facets[i] = {&polygons[i], 1, nullptr, 0};
  }
  tetgenio in, out;
  in.firstnumber = 0;
  in.numberofpoints = int(surface.points.size());
  in.pointlist = new double[3 * surface.points.size()];  // tetgenio deletes it
  std::copy_n(surface.points.data()->data(), 3 * surface.points.size(), in.pointlist);
  in.facetlist = facets.data();
  in.numberoffacets = int(facets.size());
  char switches[] = "pYM0/1T1e-5JzQ";
  tetgenbehavior behavior;
  behavior.parse_commandline(switches);
  const rivals::Watch watch;
  tetrahedralize(&behavior, &in, &out);
  watch.print(out.numberoftetrahedra);
  in.facetlist = nullptr;  // lent
}
