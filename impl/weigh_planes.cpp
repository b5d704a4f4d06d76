#include "weigh_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "collapse_rules.hpp"
#include "portable_math.hpp"

namespace tetlod {

namespace {

/// Of the vertices, those that stay longest, whose losses say nothing.
constexpr double part_that_stays = 0.25;

/// Squares that are lost where one vertex stands for its neighbours on the boundary, too.
struct Losses {
  double field = 0, planes = 0;
};

/// Quadrics of several vertices, each nothing where its vertex is, kept about one place.
template <std::size_t n>
struct QuadricsAround {
  LocalQuadric<n> sum;
  double here = 0;

  /// way: from the vertex of `quadric` to the place.
  void add(const LocalQuadric<n> &quadric, const Vector<n> &way) {
    const LocalQuadric<n> moved = quadric.moved(way);
    here += dot<n>(moved.g, way);
    sum.add(moved);
  }
  double after(const Vector<n> &step) const { return std::max(0.0, here + sum.rise(step)); }
};

/// Others stay, and would take long.
template <std::size_t m>
bool has_usual_star(const SolidMesh<m> &mesh, std::int32_t v) {
  return mesh.triangles_of.of(v).size() <= longest_ring;
}

template <std::size_t m>
LocalQuadric<3> planes_of(const SolidMesh<m> &mesh, std::int32_t v) {
  LocalQuadric<3> planes;
  for (std::int32_t t : mesh.triangles_of.of(v)) planes.add_plane(mesh.normal(t), 1);
  return planes;
}

/// What a vertex and its neighbours say, kept where it is.
template <std::size_t m>
class AllAround {
 public:
  AllAround(const SolidMesh<m> &mesh, std::int32_t v) : mesh_(mesh), place_(mesh.place(v)) {
    add(v);
    for (std::int32_t t : mesh.triangles_of.of(v)) {
      const Triangle &f = mesh.triangles[std::size_t(t)];
      const auto k = std::size_t(std::find(f.begin(), f.end(), v) - f.begin());
      add(f[(k + 1) % 3]);  // each neighbour once, as the boundary is closed
    }
  }

  /// With the values that suit the field best there, and, of planes, at the place that suits them best.
  Losses losses() const {
    Vector<3 + m> other_values{};
    for (std::size_t i = 3; i < 3 + m; i++) other_values[i] = -field_.sum.g[i] / field_.sum.a[entry_of(i, i)];
    return {field_.after(other_values), planes_.after(step_to_planes())};
  }

 private:
  void add(std::int32_t v) {
    if (!has_usual_star(mesh_, v)) return;
    const Vector<3 + m> way = minus(place_, mesh_.place(v));
    field_.add(mesh_.quadric(v), way);
    planes_.add(planes_of(mesh_, v), {way[0], way[1], way[2]});
  }

  /// A small pull keeps it near, along what is plane.
  Vector<3> step_to_planes() const {
    constexpr double pull = 1e-3;
    Triangular<3> a = planes_.sum.a;
    for (std::size_t i = 0; i < 3; i++) a[entry_of(i, i)] += pull / 3 * trace<3>(planes_.sum.a);
    const Cholesky<3> solver(a, 0);
    return solver.regular() ? solver.solve(along(Vector<3>{}, -1, planes_.sum.g)) : Vector<3>{};
  }

  const SolidMesh<m> &mesh_;
  Vector<3 + m> place_;
  QuadricsAround<3 + m> field_;
  QuadricsAround<3> planes_;
};

template <std::size_t m>
Array<std::int32_t> boundary_vertices(const SolidMesh<m> &mesh, Job &job) {
  Array<std::int32_t> vertices(&job.memory);
  for (std::size_t v = 0; v < mesh.points.size(); v++)
    if (mesh.on_boundary(std::int32_t(v)) && has_usual_star(mesh, std::int32_t(v))) vertices.push_back(std::int32_t(v));
  return vertices;
}

Array<double> sorted(const Array<Losses> &losses, double Losses::*part, Memory &memory) {
  Array<double> values(&memory);
  for (const Losses &l : losses) values.push_back(l.*part);
  std::sort(values.begin(), values.end());
  return values;
}

double sum_without_largest(const Array<double> &sorted, double part) {
  return std::accumulate(sorted.begin(), sorted.end() - std::ptrdiff_t(part * double(sorted.size())), 0.0);
}

/// A field that is linear in pieces, or jumps, loses at few vertices alone: there it has to be held, and elsewhere to
/// hold the planes costs nothing.
double field_loss(const Array<double> &sorted) {
  constexpr double peaks = 0.02, share_of_others = 0.01;
  return std::max(sum_without_largest(sorted, part_that_stays), share_of_others * sum_without_largest(sorted, peaks));
}

/// Of field and planes apart, without the largest.
Losses sum_of(const Array<Losses> &losses, Memory &memory) {
  return {field_loss(sorted(losses, &Losses::field, memory)),
          sum_without_largest(sorted(losses, &Losses::planes, memory), part_that_stays)};
}

/// By experience, as tests/bench/ACCURACY.md tells. share: of the vertices, on the boundary. A boundary with fewer than
/// the least has as large a part of what is left, if that is coarse, and then to hold it costs what the field needs.
double weight_of(const Losses &losses, double share) {
  constexpr double least = 3, by_losses = 4.5, most_losses = 2e4, usual_share = 0.7, least_share = 0.3;
  const double ratio = losses.field < most_losses * losses.planes ? losses.field / losses.planes : most_losses;
  const double few_on_boundary = usual_share / std::max(share, least_share);
  const double of_inside = power(few_on_boundary, 6) * std::sqrt(few_on_boundary);
  return least + by_losses * std::sqrt(ratio) * (1 + of_inside);
}

}  // namespace

template <std::size_t m>
double weigh_planes(const SolidMesh<m> &mesh, Job &job) {
  constexpr std::size_t enough = 1024;  // in a sample: the weight is within 3 % of that of all
  constexpr std::size_t block = 64;     // few, as each takes long
  const Array<std::int32_t> boundary = boundary_vertices(mesh, job);
  const std::size_t step = boundary.size() / enough + 1;
  Array<Losses> losses = array_of((boundary.size() + step - 1) / step, Losses(), job);
  job.parallel.for_blocks(losses.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) losses[i] = AllAround<m>(mesh, boundary[i * step]).losses();
    job.poll(0);
  });
  return weight_of(sum_of(losses, job.memory), double(boundary.size()) / double(mesh.points.size()));
}

double planes_at_size(double kept) {
  constexpr double usual = 0.1;
  return power(std::max(1.0, kept / usual), 2);
}

template double weigh_planes(const SolidMesh<1> &, Job &);
template double weigh_planes(const SolidMesh<2> &, Job &);
template double weigh_planes(const SolidMesh<3> &, Job &);
template double weigh_planes(const SolidMesh<4> &, Job &);

}  // namespace tetlod
