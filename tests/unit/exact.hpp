// Exact arithmetic for the tests of the predicates: integers of 512 bits, and fractions of small integers.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh.hpp"

namespace tetlod::test {

/// Two's complement, modulo 2^512.
class Wide {
 public:
  Wide() = default;
  /// x 2^100, which has to be an integer below 2^164: doubles of moderate size, down to the last bit.
  explicit Wide(double x) {
    int exponent;
    const double fraction = std::frexp(std::abs(x), &exponent);
    const auto mantissa = std::uint64_t(std::ldexp(fraction, 53));
    const int shift = exponent - 53 + 100;
    for (int bit = 0; bit < 53; bit++)
      if (mantissa >> bit & 1) limb_.at(std::size_t((bit + shift) / 32)) |= std::uint32_t(1) << ((bit + shift) % 32);
    if (x < 0) *this = Wide() - *this;
  }

  friend Wide operator+(const Wide &a, const Wide &b) {
    Wide sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limbs; i++) {
      carry += std::uint64_t(a.limb_[i]) + b.limb_[i];
      sum.limb_[i] = std::uint32_t(carry);
      carry >>= 32;
    }
    return sum;
  }
  friend Wide operator-(const Wide &a, const Wide &b) {
    Wide difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < limbs; i++) {
      const std::uint64_t d = std::uint64_t(a.limb_[i]) - b.limb_[i] - borrow;
      difference.limb_[i] = std::uint32_t(d);
      borrow = d >> 63;
    }
    return difference;
  }
  friend Wide operator*(const Wide &a, const Wide &b) {
    Wide product;
    for (std::size_t i = 0; i < limbs; i++) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; i + j < limbs; j++) {
        carry += std::uint64_t(a.limb_[i]) * b.limb_[j] + product.limb_[i + j];
        product.limb_[i + j] = std::uint32_t(carry);
        carry >>= 32;
      }
    }
    return product;
  }
  int sign() const {
    if (limb_[limbs - 1] >> 31) return -1;
    for (std::uint32_t l : limb_)
      if (l) return 1;
    return 0;
  }

 private:
  static constexpr std::size_t limbs = 16;
  std::array<std::uint32_t, limbs> limb_{};
};

inline int exact_orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  Wide m[3][3];
  const Vec3 *ends[3] = {&b, &c, &d};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) m[i][k] = Wide((*ends[i])[k]) - Wide(a[k]);
  const Wide cofactor0 = m[1][1] * m[2][2] - m[1][2] * m[2][1];
  const Wide cofactor1 = m[1][2] * m[2][0] - m[1][0] * m[2][2];
  const Wide cofactor2 = m[1][0] * m[2][1] - m[1][1] * m[2][0];
  return (m[0][0] * cofactor0 + m[0][1] * cofactor1 + m[0][2] * cofactor2).sign();
}

inline int exact_turn(const Vec3 &a, const Vec3 &b, const Vec3 &c, int i, int j) {
  const auto d = [&](const Vec3 &to, int k) { return Wide(to[k]) - Wide(a[k]); };
  return (d(b, i) * d(c, j) - d(b, j) * d(c, i)).sign();
}

/// A point with rational coordinates, all over the same denominator.
struct RationalPoint {
  __extension__ using Integer = __int128;
  Integer x, y, z, w;  // w > 0

  static RationalPoint of(const Vec3 &p) {
    return {Integer(std::int64_t(p.x)), Integer(std::int64_t(p.y)), Integer(std::int64_t(p.z)), 1};
  }
};

/// A plane with small integer coefficients: n . p = d.
struct LatticePlane {
  std::int64_t n[3], d;
  RationalPoint::Integer value_at(const RationalPoint &p) const {
    return n[0] * p.x + n[1] * p.y + n[2] * p.z - d * p.w;
  }
};

/// Both triangles have their corners on a lattice of small integers, the first has an area. The corners of the
/// polygon, segment or point that they have in common.
std::vector<RationalPoint> common_part(const Vec3 *first, const Vec3 *second);

/// triangles_apart by common_part.
bool brute_apart(const Vec3 *first, const Triangle &first_ids, const Vec3 *second, const Triangle &second_ids);

}  // namespace tetlod::test
