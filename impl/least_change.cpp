#include "least_change.hpp"

#include <algorithm>
#include <cmath>

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// A sum of gradients times themselves.
struct Moments {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(const Vec3 &g, double weight) {
    if (!std::isfinite(weight * glm::dot(g, g))) return;
    xx += weight * g.x * g.x;
    yy += weight * g.y * g.y;
    zz += weight * g.z * g.z;
    xy += weight * g.x * g.y;
    xz += weight * g.x * g.z;
    yz += weight * g.y * g.z;
  }
  void divide_by(double sum) {
    for (double *entry : {&xx, &yy, &zz, &xy, &xz, &yz}) *entry /= sum;
  }
  double trace() const { return xx + yy + zz; }
  double minors() const { return xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz; }
  double determinant() const { return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz); }
};

template <std::size_t m>
void add_gradients(const MeshView &mesh, const Tet &t, Moments &moments) {
  const auto p = [&](int k) { return mesh.points[std::size_t(t[std::size_t(k)])]; };
  const auto value = [&](int k, std::size_t i) { return mesh.values<m>()[std::size_t(t[std::size_t(k)])][i]; };
  const TetFrame frame(p(0), p(1), p(2), p(3));
  const double volume = std::abs(det(p(0), p(1), p(2), p(3)));
  for (std::size_t i = 0; i < m; i++)
    moments.add(mesh.scales.weighted[i] * frame.gradient(value(0, i), value(1, i), value(2, i), value(3, i)), volume);
}

/// So that about so many of all are taken, and of cells that were cut into 5, 6, 12 or 24 tets not always the same one.
std::size_t step_to(std::size_t enough, std::size_t all) {
  std::size_t step = all / enough + 1;
  while (step > 1 && (step % 2 == 0 || step % 3 == 0 || step % 5 == 0)) step++;
  return step;
}

}  // namespace

double least_change(const MeshView &mesh) {
  constexpr std::size_t enough = 4096;
  Moments moments;
  with_fields(mesh.fields, [&](auto m) {
    const std::size_t step = step_to(enough, mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); t += step) add_gradients<m>(mesh, mesh.tets[t], moments);
  });
  moments.divide_by(moments.trace());
  // The least of the three eigenvalues, where it is far below the others, is this quotient.
  const double minors = moments.minors();
  return minors > 1e-12 ? std::max(moments.determinant() / minors, 0.0) : 0;
}

}  // namespace tetlod
