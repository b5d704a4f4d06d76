// Closed surfaces for the tests of remeshing, and points inside them.
#pragma once
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <random>
#include <utility>

#include "mesh.hpp"

namespace tetlod::test {

inline void append(Surface &to, const Surface &from, bool inside_out = false) {
  const auto first = std::int32_t(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (Triangle t : from.triangles) {
    if (inside_out) std::swap(t[1], t[2]);
    for (std::int32_t &corner : t) corner += first;
    to.triangles.push_back(t);
  }
}

inline void transform(Surface &surface, const std::function<Vec3(const Vec3 &)> &function) {
  for (Vec3 &p : surface.points) p = function(p);
}

/// A box whose faces have n x n squares, split into triangles.
inline Surface box(Memory &memory, int n, const Vec3 &low = Vec3(0), const Vec3 &high = Vec3(1)) {
  Surface surface(memory);
  std::map<std::array<int, 3>, std::int32_t> ids;
  const auto id = [&](std::array<int, 3> p) {
    const auto [found, is_new] = ids.emplace(p, std::int32_t(surface.points.size()));
    if (is_new) surface.points.push_back(low + (high - low) * Vec3(p[0], p[1], p[2]) / double(n));
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; axis++)
    for (int side = 0; side < 2; side++)
      for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side * n;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            return id(p);
          };
          const std::int32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side) {
            surface.triangles.push_back({a, b, c});
            surface.triangles.push_back({a, c, d});
          } else {
            surface.triangles.push_back({a, c, b});
            surface.triangles.push_back({a, d, c});
          }
        }
  return surface;
}

/// A cube blown up to a sphere.
inline Surface sphere(Memory &memory, int n, double radius = 1, const Vec3 &centre = Vec3(0)) {
  Surface surface = box(memory, n, Vec3(-1), Vec3(1));
  transform(surface, [&](const Vec3 &p) { return centre + radius * glm::normalize(p); });
  return surface;
}

inline Surface torus(Memory &memory, int around, int across, double major = 1, double minor = 0.4) {
  Surface surface(memory);
  const auto id = [&](int i, int j) { return std::int32_t((i % around) * across + j % across); };
  for (int i = 0; i < around; i++)
    for (int j = 0; j < across; j++) {
      const double u = 2 * M_PI * i / around, v = 2 * M_PI * j / across;
      const double r = major + minor * std::cos(v);
      surface.points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
      surface.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      surface.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return surface;
}

/// Joins vertices at the same place, so that solids that touch share them.
inline Surface welded(Memory &memory, const Surface &surface) {
  Surface result(memory);
  std::map<std::array<double, 3>, std::int32_t> ids;
  for (Triangle t : surface.triangles) {
    for (std::int32_t &corner : t) {
      const Vec3 &p = surface.points[std::size_t(corner)];
      const auto [found, is_new] = ids.emplace(std::array<double, 3>{p.x, p.y, p.z}, std::int32_t(ids.size()));
      if (is_new) result.points.push_back(p);
      corner = found->second;
    }
    result.triangles.push_back(t);
  }
  return result;
}

inline glm::dmat3 random_rotation(std::mt19937_64 &random) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const Vec3 x = glm::normalize(vector());
  const Vec3 y = glm::normalize(glm::cross(x, vector()));
  return {x, y, glm::cross(x, y)};
}

/// Random points for which `inside` holds, from the box [-extent, extent]^3.
inline Array<Vec3> random_points(Memory &memory, std::size_t count, double extent,
                                 const std::function<bool(const Vec3 &)> &inside, unsigned seed = 1) {
  Array<Vec3> points(&memory);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-extent, extent);
  while (points.size() < count) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    if (inside(p)) points.push_back(p);
  }
  return points;
}

}  // namespace tetlod::test
