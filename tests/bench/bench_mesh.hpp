// The meshes that are simplified: one read from a file, one made here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bench {

using Point = std::array<double, 3>;
using Tet = std::array<std::int32_t, 4>;
using Triangle = std::array<std::int32_t, 3>;

struct Mesh {
  std::vector<Point> points;
  std::vector<Tet> tets;
  std::vector<double> values;  // one a point
};

// Greatest less least value; 1 for a constant field, so that errors stay absolute there.
double range_of(const std::vector<double> &values);

// The tets of a .vtu file with its active scalars, or its first point data of one component. Throws
// std::runtime_error.
Mesh read_mesh(const std::string &path);

// `name` in the folder that the environment's TETLOD_DATA_DIR names, else in ../shared/data beside the checkout.
std::optional<std::string> find_data(const std::string &name);

// The file of a set by its name there, or that is named itself. Where there is none a line says that it is skipped.
std::optional<std::string> find_set(const std::string &name);

// Each tet in eight around the middles of its edges, where the values are those between. The field is the same.
Mesh refined(const Mesh &mesh);

// In the unit cube: a bent front, steep across and smooth along, that travels through a slow swell as `time` goes from
// 0 to 1.
double front_value(const Point &p, double time);

// The unit cube of cubes, each cut into six tets around its diagonal, as near to `tets` as whole cubes allow, with that
// front.
Mesh make_front_mesh(std::int64_t tets, double time);

}  // namespace bench
