// SPDX-License-Identifier: AGPL-3.0-or-later
// The only file that sees TetGen.
#include "tetgen_call.hpp"

#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "channel.hpp"

// libtet calls terminatetetgen through its symbol table, where the definition of the executable comes first. The
// header's own inline definition is moved out of the way by renaming it.
#define TETLIBRARY
#define terminatetetgen terminatetetgen_of_the_header
#include <tetgen.h>
#undef terminatetetgen

namespace tetlod::worker {

namespace {

const char *meaning(int code) {
  switch (code) {
    case protocol::out_of_memory: return "out of memory";
    case protocol::internal_error: return "an internal error";
    case 3: return "a self-intersection of the boundary";
    case 4: return "a feature too small for its tolerance";
    case 5: return "two facets too close to each other";
    case 10: return "refused the input";
    default: return "an unknown code";
  }
}

}  // namespace

}  // namespace tetlod::worker

// The original frees the mesh and throws, whereupon the destructor frees it again.
[[gnu::visibility("default")]] void terminatetetgen(tetgenmesh *, int code) {
  tetlod::worker::fail(code, tetlod::worker::meaning(code));
}

// 272 assertions are compiled into libtet; the original would abort (and write a core).
extern "C" [[gnu::visibility("default"), gnu::noreturn]] void __assert_fail(const char *expression, const char *,
                                                                            unsigned line, const char *) noexcept {
  char text[sizeof tetlod::protocol::Reply::text];
  std::snprintf(text, sizeof text, "assertion at line %u: %s", line, expression);
  tetlod::worker::fail(tetlod::protocol::internal_error, text);
}

namespace tetlod::worker {

namespace {

/// The facets of a tetgenio, in three blocks instead of three allocations for each triangle.
class Facets {
 public:
  Facets(std::size_t count, RequestReader &request) : corners_(3 * count), polygons_(count), facets_(count) {
    request.read(corners_.data(), protocol::triangle_bytes * count);
    for (std::size_t i = 0; i < count; i++) {
      polygons_[i] = {&corners_[3 * i], 3};
      facets_[i] = {&polygons_[i], 1, nullptr, 0};
    }
  }
  void lend(tetgenio &io) {
    io.facetlist = facets_.data();
    io.numberoffacets = int(facets_.size());
  }
  /// Before the tetgenio is destroyed, which would free what is lent.
  static void take_back(tetgenio &io) { io.facetlist = nullptr; }

 private:
  std::vector<int> corners_;
  std::vector<tetgenio::polygon> polygons_;
  std::vector<tetgenio::facet> facets_;
};

void read_points(tetgenio &io, std::int64_t count, RequestReader &request) {
  io.firstnumber = 0;
  io.pointlist = new double[std::size_t(3 * count)];
  io.numberofpoints = int(count);
  request.read(io.pointlist, protocol::point_bytes * std::uint64_t(count));
}

std::vector<std::int32_t> regions(const tetgenio &out) {
  std::vector<std::int32_t> result;
  if (out.numberoftetrahedronattributes < 1) return result;
  result.resize(std::size_t(out.numberoftetrahedra));
  for (std::size_t i = 0; i < result.size(); i++)
    result[i] = std::int32_t(out.tetrahedronattributelist[i * std::size_t(out.numberoftetrahedronattributes)]);
  return result;
}

protocol::Reply write_result(const tetgenio &out) {
  if (out.numberofcorners != 4) fail(protocol::internal_error, "tets without four corners");
  const std::vector<std::int32_t> region = regions(out);
  protocol::Reply reply;
  reply.points = out.numberofpoints;
  reply.tets = out.numberoftetrahedra;
  reply.regions = std::int64_t(region.size());
  ResponseWriter response;
  response.write(out.pointlist, protocol::point_bytes * std::uint64_t(reply.points));
  response.write(out.tetrahedronlist, protocol::tet_bytes * std::uint64_t(reply.tets));
  response.write(region.data(), protocol::region_bytes * std::uint64_t(reply.regions));
  return reply;
}

}  // namespace

bool has_exact_predicates() {
  // Exactly on a sphere; where products are not rounded before they are summed the last is found off it.
  REAL p[5][3] = {{187698667, 239615633, 51786118},
                  {314896578, 205924623, -41720783},
                  {187698667, 239615633, -12649282},
                  {310277069, 107798213, 51786118},
                  {183079158, 112417722, -12649282}};
  for (auto &point : p)
    for (REAL &coordinate : point) coordinate = std::ldexp(coordinate, -30);
  exactinit(0, 0, 0, 1, 1, 1);
  return insphere(p[0], p[1], p[2], p[3], p[4]) == 0;
}

protocol::Reply tetrahedralize(const protocol::Call &call) {
  tetgenbehavior behavior;
  char switches[sizeof call.switches];
  std::snprintf(switches, sizeof switches, "%s", call.switches);
  if (!behavior.parse_commandline(switches)) fail(10, "switches that TetGen does not know");

  RequestReader request;
  tetgenio in, inserted, out;
  read_points(in, call.points, request);
  read_points(inserted, call.inserted, request);
  Facets facets(std::size_t(call.triangles), request);
  facets.lend(in);

  std::srand(1);  // TetGen draws from rand(): the same for the first call of a process and for later ones
  ::tetrahedralize(&behavior, &in, &out, call.inserted ? &inserted : nullptr);
  Facets::take_back(in);
  return write_result(out);
}

}  // namespace tetlod::worker
