// Systems of four equations.
#pragma once
#include <array>
#include <cmath>

namespace tetlod {

using Vec4 = std::array<double, 4>;

inline double dot4(const Vec4 &a, const Vec4 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

/// A symmetric positive definite system by Cholesky, of its lower triangle, row by row; not regular where a pivot is
/// not above `least_pivot`.
class Solver4 {
 public:
  Solver4(const std::array<double, 10> &a, double least_pivot) : l_(a) {
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = 0; j <= i; j++) {
        double sum = at(i, j);
        for (std::size_t k = 0; k < j; k++) sum -= at(i, k) * at(j, k);
        if (i == j && !(sum > least_pivot)) return;
        at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
      }
    regular_ = true;
  }
  bool regular() const { return regular_; }
  Vec4 solve(Vec4 b) const {
    for (std::size_t i = 0; i < 4; i++) {
      for (std::size_t k = 0; k < i; k++) b[i] -= at(i, k) * b[k];
      b[i] /= at(i, i);
    }
    for (std::size_t i = 4; i-- > 0;) {
      for (std::size_t k = i + 1; k < 4; k++) b[i] -= at(k, i) * b[k];
      b[i] /= at(i, i);
    }
    return b;
  }

 private:
  double &at(std::size_t i, std::size_t j) { return l_[i * (i + 1) / 2 + j]; }
  double at(std::size_t i, std::size_t j) const { return l_[i * (i + 1) / 2 + j]; }
  std::array<double, 10> l_;
  bool regular_ = false;
};

}  // namespace tetlod
