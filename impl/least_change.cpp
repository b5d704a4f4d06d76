#include "least_change.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// A sum of gradients times themselves.
using Moments = glm::dmat3;

double trace(const Moments &a) { return a[0][0] + a[1][1] + a[2][2]; }

/// Of two eigenvalues each, their products' sum.
double minors(const Moments &a) {
  double sum = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < i; j++) sum += a[i][i] * a[j][j] - a[i][j] * a[j][i];
  return sum;
}

template <std::size_t m>
void add_gradients(const MeshView &mesh, const Tet &t, Moments &moments) {
  const auto p = [&](int k) { return mesh.points[std::size_t(t[std::size_t(k)])]; };
  const auto value = [&](int k, std::size_t i) { return mesh.values<m>()[std::size_t(t[std::size_t(k)])][i]; };
  const TetFrame frame(p(0), p(1), p(2), p(3));
  const double volume = std::abs(six_volume(mesh.points, t));
  for (std::size_t i = 0; i < m; i++) {
    const Vec3 g = mesh.scales.weighted[i] * frame.gradient(value(0, i), value(1, i), value(2, i), value(3, i));
    if (std::isfinite(volume * glm::dot(g, g))) moments += volume * glm::outerProduct(g, g);
  }
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
  Moments moments(0);
  with_fields(mesh.fields, [&](auto m) {
    const std::size_t step = step_to(enough, mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); t += step) add_gradients<m>(mesh, mesh.tets[t], moments);
  });
  moments /= trace(moments);
  // The least of the three eigenvalues, where it is far below the others, is this quotient.
  const double products = minors(moments);
  return products > 1e-12 ? std::max(glm::determinant(moments) / products, 0.0) : 0;
}

}  // namespace tetlod
