// What holds for every result, whatever the input was. Each of these aborts with the promise that does not hold.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "meshes.hpp"
#include "reference.hpp"

namespace fuzz {

/// A result as it was fetched, in double precision and with numbers from 0.
struct Fetched {
  std::vector<Point> points;
  std::vector<double> values;
  std::vector<Corners> tets;
  std::vector<Face> boundary;
};

/// Of two tets on one face that are not flat, there is one on either side; where there is not, points may be moved.
bool are_side_by_side(const std::vector<Point> &points, const std::vector<Corners> &tets);

/// Every corner is a point, and every point a corner.
void check_corners(const std::vector<Corners> &tets, std::size_t points);
/// det(p1 - p0, p2 - p0, p3 - p0) > 0 as doubles compute it, after an exact scaling to one.
void check_positive(const std::vector<Point> &points, const std::vector<Corners> &tets);
/// A face is used once or, from both sides, twice; those used once are the boundary, seen from outside.
void check_conforming(const std::vector<Corners> &tets, const std::vector<Face> &boundary);
/// No hole in the surface, and it meets itself nowhere but at common vertices and edges.
void check_surface(const std::vector<Point> &points, const std::vector<Face> &boundary);
/// ... but where solids are in contact: then none of its components does.
void check_components(const std::vector<Point> &points, const std::vector<Face> &boundary);
/// Components and Euler characteristic of the surface as it is.
void check_same_topology(const std::vector<Face> &original, const std::vector<Face> &boundary);
/// ... and cut apart where it touches itself. Neither may cross itself: which sheets belong together at an edge is then
/// a matter of chance.
void check_same_cut_topology(const std::vector<Point> &before, const std::vector<Face> &original,
                             const std::vector<Point> &after, const std::vector<Face> &boundary);
/// No vertex of either surface is further from the other than `bound` times the diagonal of the first.
void check_deviation(const std::vector<Point> &before, const std::vector<Face> &original,
                     const std::vector<Point> &after, const std::vector<Face> &boundary, double bound);
void check_values(const std::vector<double> &values, double low, double high);

/// All of it, for the result of a run with this mesh, which takes solids in contact or does not.
void check_result(const Mesh &mesh, const Facts &facts, const Fetched &result, bool takes_contacts);

}  // namespace fuzz
