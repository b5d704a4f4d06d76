// Small symmetric systems.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace tetlod {

template <std::size_t n>
using Vector = std::array<double, n>;

template <std::size_t n>
double dot(const Vector<n> &a, const Vector<n> &b) {
  double sum = a[0] * b[0];
  for (std::size_t i = 1; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/// Of a symmetric matrix, the lower triangle, row by row.
template <std::size_t n>
using Triangular = std::array<double, n *(n + 1) / 2>;

/// Where that has the entry of row i and column j <= i.
constexpr std::size_t entry_of(std::size_t i, std::size_t j) { return i * (i + 1) / 2 + j; }

template <std::size_t n>
Vector<n> times(const Triangular<n> &a, const Vector<n> &x) {
  Vector<n> image;
  for (std::size_t i = 0; i < n; i++) {
    image[i] = a[entry_of(i, 0)] * x[0];
    for (std::size_t j = 1; j < n; j++) image[i] += a[i < j ? entry_of(j, i) : entry_of(i, j)] * x[j];
  }
  return image;
}

template <std::size_t n>
double trace(const Triangular<n> &a) {
  double sum = a[0];
  for (std::size_t i = 1; i < n; i++) sum += a[entry_of(i, i)];
  return sum;
}

/// A positive definite system by Cholesky; not regular where a pivot is not above `least_pivot`.
template <std::size_t n>
class Cholesky {
 public:
  Cholesky(const Triangular<n> &a, double least_pivot) : l_(a) {
    for (std::size_t i = 0; i < n; i++)
      for (std::size_t j = 0; j <= i; j++) {
        double sum = at(i, j);
        for (std::size_t k = 0; k < j; k++) sum -= at(i, k) * at(j, k);
        if (i == j && !(sum > least_pivot)) return;
        at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
      }
    regular_ = true;
  }
  bool regular() const { return regular_; }
  Vector<n> solve(Vector<n> b) const {
    for (std::size_t i = 0; i < n; i++) {
      for (std::size_t k = 0; k < i; k++) b[i] -= at(i, k) * b[k];
      b[i] /= at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; k++) b[i] -= at(k, i) * b[k];
      b[i] /= at(i, i);
    }
    return b;
  }

 private:
  double &at(std::size_t i, std::size_t j) { return l_[entry_of(i, j)]; }
  double at(std::size_t i, std::size_t j) const { return l_[entry_of(i, j)]; }
  Triangular<n> l_;
  bool regular_ = false;
};

}  // namespace tetlod
