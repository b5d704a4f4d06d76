// Generated meshes and surfaces for the tests of the stages.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "job.hpp"
#include "mesh.hpp"
#include "pipeline.hpp"

namespace tetlod::test {

/// What a stage wants from its run.
struct Host {
  explicit Host(int threads = 1) : parallel(threads) {}
  Memory memory;
  Parallel parallel;
  Job job{memory, parallel};
};

/// Of arrays, or of what is made of them.
template <class T>
T copy_of(const T &original, Host &host) {
  const auto empty = [&] {
    if constexpr (std::is_constructible_v<T, Memory &>)
      return T(host.memory);
    else
      return T(&host.memory);
  };
  T copy = empty();
  copy = original;
  return copy;
}

/// A tet mesh with arrays of its own.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<double> scalars;
  std::vector<Tet> tets;

  MeshView view() const {
    return {{points.data(), points.size()}, {scalars.data(), scalars.size()}, {tets.data(), tets.size()}};
  }
};

using Cell = std::array<int, 3>;
using Field = std::function<double(const Vec3 &)>;

/// The cells of a lattice of unit cubes for which `solid` holds, each cut into six tets along the diagonal from its
/// lowest to its highest corner (Kuhn), so that neighbours fit. Cell c has the tets from 6 times its rank on. Points
/// that no cell uses are left out. Scalars are zero.
Mesh kuhn_solid(const Cell &cells, const std::function<bool(const Cell &)> &solid);

/// The cube [0, 1]^3 in n^3 cells.
Mesh kuhn_cube(int n);

/// [0, 1]^3 in n^3 cells, each cut in five tets, all in the same way: every quad between two cells is cut along both
/// diagonals.
Mesh cubes_in_five(int n);

/// [0, 1]^3 in n^3 cells, each of which is 8^level_of(it) ones; these are cut in six tets as above. Points at one place
/// are one, so that some hang on edges and faces where a coarse cell is next to a fine one.
/// seed: not 0, cells are cut along diagonals at random.
constexpr int most_levels = 2;
Mesh refined_cubes(int n, const std::function<int(const Cell &)> &level_of, unsigned seed = 0);

/// A slab of n x n x layers cells with slits in its middle, each one cell wide and next to nothing high.
Mesh slab_with_slits(int n, int layers);

/// Faces between tets for which `is_cracked` holds become two: points there are one for each of the sides that the
/// cracks leave, at one place. A field may be told from which side it is asked: `towards` leads into it.
using Face = std::array<Vec3, 3>;
using SidedField = std::function<double(const Vec3 &, const Vec3 &towards)>;
Mesh cracked(const Mesh &mesh, const std::function<bool(const Face &)> &is_cracked, const SidedField &field);

/// The cube [0, 1]^3 in n^3 cells, n even, with a round crack in the middle, across which the field jumps by `jump`.
Mesh cracked_cube(int n, double jump);
/// It is open by so much.
Mesh open_cracked_cube(int n, double by);
/// The same where hexahedra were split one by one: all quads between the halves are cut along different diagonals from
/// their two sides. In n^3 unit cells; scalars are 0 below, and `jump` above.
Mesh cracked_where_quads_cross(int n, double jump);

/// n^3 cells, each solid with the given probability, the lowest always: touches itself at edges and vertices, has
/// tunnels, cavities and several components.
Mesh random_solid(int n, double probability, unsigned seed);

void set_scalars(Mesh &mesh, const Field &field);
void transform(Mesh &mesh, const std::function<Vec3(const Vec3 &)> &function);
void append(Mesh &to, const Mesh &from);
/// The same tets, each with points of its own.
Mesh with_points_of_their_own(const Mesh &mesh);

/// The tets in random order, their corners in random order: half of them wind the other way.
void shuffle(Mesh &mesh, unsigned seed);

double volume_of(const Mesh &mesh);

/// The whole mesh as a result of the pipeline, tets wound positive.
TetMesh as_result(const Mesh &mesh, Memory &memory);

/// The boundary as decimation gets it.
Surface surface_of(const Mesh &mesh, Job &job);

/// A sphere whose radius is a smooth random function of the direction, between 0.5 and 1.5, in 12 n^2 triangles.
Surface random_blob(Memory &memory, int n, unsigned seed);

/// A star of six thin spikes: a small cube's faces drawn out to points, in 12 n^2 triangles; n is even.
Surface spiky_star(Memory &memory, int n);

/// Values and origins for a surface that has none: the values of `field`, origin i for point i.
void complete(Surface &surface, const Field &field);

/// A contiguous array of the caller, `stride` elements from one tuple to the next.
template <class T>
StridedArray strided(const T *data, std::size_t tuples, int components, std::size_t stride, ElementType type) {
  StridedArray array;
  array.type = type;
  array.tuples = std::int64_t(tuples);
  array.components = components;
  array.tuple_stride = std::int64_t(stride * sizeof(T));
  array.component_stride = sizeof(T);
  array.data = reinterpret_cast<unsigned char *>(const_cast<T *>(data));
  array.present = true;
  return array;
}

/// The mesh as a caller of doubles and int32 submits it.
Input input_of(const Mesh &mesh);

}  // namespace tetlod::test
