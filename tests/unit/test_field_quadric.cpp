// The quadrics of a boundary that sees fields, against distances from planes and against searches.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "field_quadric.hpp"

namespace tetlod {
namespace {

using Point = Vector<4>;

Point random_point(std::mt19937_64 &random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Point p;
  for (double &x : p) x = uniform(random);
  return p;
}

Point between(const Point &a, const Point &b, double t) {
  Point p;
  for (std::size_t k = 0; k < 4; k++) p[k] = (1 - t) * a[k] + t * b[k];
  return p;
}

double distance2(const Point &a, const Point &b) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// Gram's determinant of the ways from p to the others: the squared volume of what they span.
double gram2(const Point &p, const Point &q, const Point &r) {
  const double qq = distance2(p, q), rr = distance2(p, r), qr = 0.5 * (qq + rr - distance2(q, r));
  return qq * rr - qr * qr;
}
double gram3(const Point &p, const Point &q, const Point &r, const Point &s) {
  const double a = distance2(p, q), b = distance2(p, r), c = distance2(p, s);
  const double ab = 0.5 * (a + b - distance2(q, r)), ac = 0.5 * (a + c - distance2(q, s)),
               bc = 0.5 * (b + c - distance2(r, s));
  return a * (b * c - bc * bc) - ab * (ab * c - bc * ac) + ac * (ab * bc - b * ac);
}

FieldQuadric<4> random_quadric(int triangles, std::mt19937_64 &random) {
  FieldQuadric<4> sum;
  for (int i = 0; i < triangles; i++)
    sum.add(quadric_of(random_point(random), random_point(random), random_point(random)));
  return sum;
}

TEST(FieldQuadric, IsAreaTimesSquaredDistanceFromThePlane) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; i++) {
    const Point p = random_point(random), q = random_point(random), r = random_point(random), x = random_point(random);
    const double base2 = gram2(p, q, r), area = 0.5 * std::sqrt(base2);
    EXPECT_NEAR(quadric_of(p, q, r)(x), area * gram3(p, q, r, x) / base2, 1e-12);
  }
}

TEST(FieldQuadric, LeastAlongAnEdgeIsWhatASearchFinds) {
  std::mt19937_64 random(2);
  int inside = 0;
  for (int i = 0; i < 1000; i++) {
    const FieldQuadric<4> quadric = random_quadric(1 + i % 12, random);
    const Point a = random_point(random), b = random_point(random);
    Point x;
    const double least = least_along_edge(quadric, a, b, x);
    EXPECT_NEAR(quadric(x), least, 1e-12);
    EXPECT_NEAR(std::sqrt(distance2(a, x)) + std::sqrt(distance2(x, b)), std::sqrt(distance2(a, b)), 1e-12);
    for (int k = 0; k <= 100; k++) EXPECT_LE(least, quadric(between(a, b, 0.01 * k)) + 1e-12);
    inside += distance2(a, x) > 0 && distance2(b, x) > 0;
  }
  EXPECT_GT(inside, 100);  // and ends are found, too
  EXPECT_LT(inside, 900);
}

TEST(FieldQuadric, LeastOfAllIsNoMoreThanAlongTheEdgeButForThePull) {
  std::mt19937_64 random(3);
  const VolumeSums none;
  for (int i = 0; i < 1000; i++) {
    const FieldQuadric<4> quadric = random_quadric(8, random);
    const Point a = random_point(random), b = random_point(random), middle = between(a, b, 0.5);
    Point along, best = middle;
    const double least = least_along_edge(quadric, a, b, along);
    ASSERT_TRUE(place_by_quadric(quadric, none, best));
    EXPECT_LE(quadric(best), least + 1e-3 * trace<4>(quadric.a) / 4 * distance2(along, middle) + 1e-12);
  }
}

}  // namespace
}  // namespace tetlod
