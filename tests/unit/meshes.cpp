#include "meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "extract_boundary.hpp"
#include "geometry.hpp"
#include "remesh_surfaces.hpp"

namespace tetlod::test {

namespace {

/// The tets of a cell: from its lowest corner to its highest one, a step along each axis in any of six orders.
void add_cell(Mesh &mesh, const std::function<std::int32_t(const Cell &)> &id, const Cell &cell) {
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    Cell corner = cell;
    Tet tet{id(corner), 0, 0, 0};
    for (std::size_t k = 0; k < 3; k++) {
      corner[order[k]]++;
      tet[k + 1] = id(corner);
    }
    mesh.tets.push_back(tet);
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace

Mesh kuhn_solid(const Cell &cells, const std::function<bool(const Cell &)> &solid) {
  Mesh mesh;
  std::map<Cell, std::int32_t> ids;
  const auto id = [&](const Cell &corner) {
    const auto [found, is_new] = ids.emplace(corner, std::int32_t(mesh.points.size()));
    if (is_new) mesh.points.push_back(Vec3(corner[0], corner[1], corner[2]));
    return found->second;
  };
  for (int x = 0; x < cells[0]; x++)
    for (int y = 0; y < cells[1]; y++)
      for (int z = 0; z < cells[2]; z++)
        if (solid({x, y, z})) add_cell(mesh, id, {x, y, z});
  mesh.scalars.assign(mesh.points.size(), 0.0);
  return mesh;
}

Mesh kuhn_cube(int n) {
  Mesh mesh = kuhn_solid({n, n, n}, [](const Cell &) { return true; });
  transform(mesh, [n](const Vec3 &p) { return p / double(n); });
  return mesh;
}

Mesh cubes_in_five(int n) {
  Mesh mesh = kuhn_cube(n);
  const auto vertex = [&](int i, int j, int k) {
    const Vec3 p = Vec3(i, j, k) / double(n);
    for (std::size_t v = 0; v < mesh.points.size(); v++)
      if (glm::length(mesh.points[v] - p) < 1e-9) return std::int32_t(v);
    return std::int32_t(-1);
  };
  mesh.tets.clear();
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        std::int32_t v[8];
        for (int corner = 0; corner < 8; corner++)
          v[corner] = vertex(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
        for (const Tet &t : {Tet{0, 1, 2, 4}, Tet{3, 2, 1, 7}, Tet{5, 7, 1, 4}, Tet{6, 4, 2, 7}, Tet{1, 2, 4, 7}})
          mesh.tets.push_back({v[t[0]], v[t[1]], v[t[2]], v[t[3]]});
      }
  return mesh;
}

Mesh refined_cubes(int n, const std::function<int(const Cell &)> &level_of, unsigned seed) {
  constexpr int size = 1 << most_levels;
  Mesh mesh;
  std::mt19937_64 random(seed);
  std::map<Cell, std::int32_t> vertex;  // of the finest lattice
  const auto add = [&](const Mesh &cell, const Cell &low, int step) {
    const std::uint64_t mirrored = seed == 0 ? 0 : random();
    const auto at = [&](const Vec3 &p, int k) {
      const int x = int(p[k]);
      return low[std::size_t(k)] + step * (mirrored >> k & 1 ? 1 - x : x);
    };
    for (const Tet &t : cell.tets) {
      Tet tet;
      for (std::size_t k = 0; k < 4; k++) {
        const Vec3 &p = cell.points[std::size_t(t[k])];
        const Cell place{at(p, 0), at(p, 1), at(p, 2)};
        const auto [found, is_new] = vertex.emplace(place, std::int32_t(mesh.points.size()));
        if (is_new) mesh.points.push_back(Vec3(place[0], place[1], place[2]) / double(size * n));
        tet[k] = found->second;
      }
      mesh.tets.push_back(tet);
    }
  };
  const Mesh cell = kuhn_cube(1);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (int k = 0; k < n; k++) {
        const int parts = 1 << level_of({i, j, k}), step = size / parts;
        for (int x = 0; x < size; x += step)
          for (int y = 0; y < size; y += step)
            for (int z = 0; z < size; z += step) add(cell, {size * i + x, size * j + y, size * k + z}, step);
      }
  mesh.scalars.assign(mesh.points.size(), 0);
  return mesh;
}

Mesh slab_with_slits(int n, int layers) {
  const int middle = layers / 2;
  Mesh slab = kuhn_solid({n, n, layers}, [&](const Cell &c) {
    const bool is_within = c[0] >= 1 && c[0] < n - 1 && c[1] >= 1 && c[1] < n - 1;
    return !(c[2] == middle && is_within && c[1] % 2 == 1);
  });
  transform(slab, [&](const Vec3 &p) {
    const double above = std::min(std::max(p.z - middle, 0.0), 1.0);
    return Vec3(p.x / n, p.y / n, 0.1 * (p.z - 0.98 * above));
  });
  return slab;
}

Mesh cracked(const Mesh &mesh, const std::function<bool(const Face &)> &is_cracked, const SidedField &field) {
  std::vector<std::int32_t> side(4 * mesh.tets.size());  // of each corner of each tet, known by one of them
  std::iota(side.begin(), side.end(), 0);
  const auto known_by = [&](std::int32_t corner) {
    while (side[std::size_t(corner)] != corner) corner = side[std::size_t(corner)];
    return corner;
  };
  std::map<std::array<std::int32_t, 3>, std::int32_t> first;  // the tet that has a face, of two
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    for (const auto &corners : tet_face) {
      Triangle v{};
      Face face;
      for (std::size_t k = 0; k < 3; k++) v[k] = mesh.tets[t][std::size_t(corners[k])];
      for (std::size_t k = 0; k < 3; k++) face[k] = mesh.points[std::size_t(v[k])];
      std::sort(v.begin(), v.end());
      const auto [other, is_new] = first.emplace(v, std::int32_t(t));
      if (is_new || is_cracked(face)) continue;
      for (const std::int32_t u : v) {
        const auto corner = [&](std::size_t of) {
          const Tet &tet = mesh.tets[of];
          return std::int32_t(4 * of) + std::int32_t(std::find(tet.begin(), tet.end(), u) - tet.begin());
        };
        side[std::size_t(known_by(corner(t)))] = known_by(corner(std::size_t(other->second)));
      }
    }
  Mesh apart;
  apart.tets = mesh.tets;
  std::map<std::int32_t, std::int32_t> point;  // of each side
  std::vector<Vec3> towards;
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    for (std::size_t k = 0; k < 4; k++) {
      const Vec3 &p = mesh.points[std::size_t(mesh.tets[t][k])];
      const auto [of, is_new] = point.emplace(known_by(std::int32_t(4 * t + k)), std::int32_t(apart.points.size()));
      if (is_new) apart.points.push_back(p);
      if (is_new) towards.push_back(Vec3(0));
      apart.tets[t][k] = of->second;
      for (const std::int32_t v : mesh.tets[t]) towards[std::size_t(of->second)] += mesh.points[std::size_t(v)] - p;
    }
  for (std::size_t v = 0; v < apart.points.size(); v++) apart.scalars.push_back(field(apart.points[v], towards[v]));
  return apart;
}

Mesh cracked_cube(int n, double jump) {
  const auto is_in_disc = [](const Face &face) {
    return std::all_of(face.begin(), face.end(),
                       [](const Vec3 &p) { return p.z == 0.5 && std::hypot(p.x - 0.5, p.y - 0.5) < 0.35; });
  };
  return cracked(kuhn_cube(n), is_in_disc, [&](const Vec3 &p, const Vec3 &towards) {
    const double open = std::max(0.0, 0.35 - std::hypot(p.x - 0.5, p.y - 0.5)) / 0.35;
    const double side = p.z == 0.5 ? towards.z : p.z - 0.5;
    return 0.2 * p.x + std::copysign(0.5 * jump, side) * open * std::exp(-4 * std::abs(p.z - 0.5));
  });
}

Mesh cracked_where_quads_cross(int n, double jump) {
  Mesh mesh = kuhn_solid({n, n, n / 2}, [](const Cell &) { return true; });
  Mesh above = mesh;
  transform(above, [&](const Vec3 &p) { return Vec3(n - p.x, p.y, p.z + n / 2); });
  set_scalars(above, [&](const Vec3 &) { return jump; });
  const auto below = std::int32_t(mesh.points.size());
  append(mesh, above);
  for (std::int32_t v = below; v < std::int32_t(mesh.points.size()); v++) {
    const auto end = mesh.points.begin() + below,
               same = std::find(mesh.points.begin(), end, mesh.points[std::size_t(v)]);
    if (same == end || std::hypot(same->x - n / 2, same->y - n / 2) < 0.3 * n) continue;
    for (Tet &t : mesh.tets) std::replace(t.begin(), t.end(), v, std::int32_t(same - mesh.points.begin()));
  }
  return mesh;
}

Mesh open_cracked_cube(int n, double by) {
  Mesh cube = cracked_cube(n, 1);
  for (std::size_t v = 0; v < cube.points.size(); v++)
    for (std::size_t u = v + 1; u < cube.points.size(); u++)
      if (cube.points[u] == cube.points[v]) cube.points[cube.scalars[v] > cube.scalars[u] ? v : u].z += by;
  return cube;
}

Mesh random_solid(int n, double probability, unsigned seed) {
  std::mt19937_64 random(seed);
  std::bernoulli_distribution is_solid(probability);
  return kuhn_solid({n, n, n}, [&](const Cell &c) { return is_solid(random) || c == Cell{0, 0, 0}; });
}

void set_scalars(Mesh &mesh, const Field &field) {
  mesh.scalars.clear();
  for (const Vec3 &p : mesh.points) mesh.scalars.push_back(field(p));
}

void transform(Mesh &mesh, const std::function<Vec3(const Vec3 &)> &function) {
  for (Vec3 &p : mesh.points) p = function(p);
}

void append(Mesh &to, const Mesh &from) {
  const auto first = std::int32_t(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  to.scalars.insert(to.scalars.end(), from.scalars.begin(), from.scalars.end());
  for (Tet t : from.tets) {
    for (std::int32_t &v : t) v += first;
    to.tets.push_back(t);
  }
}

Mesh with_points_of_their_own(const Mesh &mesh) {
  Mesh apart;
  for (const Tet &t : mesh.tets) {
    const auto first = std::int32_t(apart.points.size());
    for (const std::int32_t v : t) {
      apart.points.push_back(mesh.points[std::size_t(v)]);
      apart.scalars.push_back(mesh.scalars[std::size_t(v)]);
    }
    apart.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  return apart;
}

void shuffle(Mesh &mesh, unsigned seed) {
  std::mt19937_64 random(seed);
  for (Tet &t : mesh.tets) std::shuffle(t.begin(), t.end(), random);
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
}

double volume_of(const Mesh &mesh) {
  double sum = 0;
  const auto at = [&](std::int32_t v) { return mesh.points[std::size_t(v)]; };
  for (const Tet &t : mesh.tets) sum += std::abs(det(at(t[0]), at(t[1]), at(t[2]), at(t[3]))) / 6;
  return sum;
}

TetMesh as_result(const Mesh &mesh, Memory &memory) {
  TetMesh result(memory);
  result.points.assign(mesh.points.begin(), mesh.points.end());
  result.scalars.assign(mesh.scalars.begin(), mesh.scalars.end());
  const auto at = [&](std::int32_t v) { return mesh.points[std::size_t(v)]; };
  for (Tet t : mesh.tets) {
    if (det(at(t[0]), at(t[1]), at(t[2]), at(t[3])) < 0) std::swap(t[2], t[3]);
    result.tets.push_back(t);
  }
  return result;
}

Surface surface_of(const Mesh &mesh, Job &job) {
  Boundary boundary(job.memory);
  extract_boundary(mesh.view(), job, boundary);
  Surface surface(job.memory);
  make_surface(mesh.view(), boundary.triangles, job, surface);
  return surface;
}

Surface random_blob(Memory &memory, int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> waves;
  for (int i = 0; i < 5; i++) waves.push_back(3.0 * Vec3(uniform(random), uniform(random), uniform(random)));
  Surface surface = sphere(memory, n);
  transform(surface, [&](const Vec3 &p) {
    double radius = 1;
    for (const Vec3 &wave : waves) radius += 0.1 * std::sin(glm::dot(wave, p) + wave.x);
    return radius * p;
  });
  complete(surface, [](const Vec3 &p) { return p.x; });
  return surface;
}

Surface spiky_star(Memory &memory, int n) {
  Surface surface = box(memory, n, Vec3(-1), Vec3(1));
  transform(surface, [](const Vec3 &p) {
    // Near the middle of a face two coordinates are small and the third is 1: that place is drawn out.
    const Vec3 size = glm::abs(p);
    const double largest = std::max({size.x, size.y, size.z});
    const double off = (size.x + size.y + size.z - largest) / largest;
    const double radius = 0.2 + 0.8 * std::pow(std::max(0.0, 1 - off), 3);
    return radius * glm::normalize(p);
  });
  complete(surface, [](const Vec3 &p) { return p.x; });
  return surface;
}

void complete(Surface &surface, const Field &field) {
  surface.scalars.clear();
  surface.origin.clear();
  for (std::size_t i = 0; i < surface.points.size(); i++) {
    surface.scalars.push_back(field(surface.points[i]));
    surface.origin.push_back(std::int32_t(i));
  }
}

Input input_of(const Mesh &mesh) {
  Input input;
  const auto *coordinates = reinterpret_cast<const double *>(mesh.points.data());
  for (std::size_t k = 0; k < 3; k++)
    input.xyz[k] =
        strided(mesh.points.empty() ? nullptr : coordinates + k, mesh.points.size(), 1, 3, ElementType::float64);
  const std::int32_t *corners = mesh.tets.empty() ? nullptr : mesh.tets.data()->data();
  input.tets = strided(corners, mesh.tets.size(), 4, 4, ElementType::int32);
  input.scalars = strided(mesh.scalars.data(), mesh.scalars.size(), 1, 1, ElementType::float64);
  return input;
}

}  // namespace tetlod::test
