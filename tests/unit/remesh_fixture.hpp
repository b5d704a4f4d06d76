// remesh() with a worker, and every promise of remesh.hpp checked anew on what it returns.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "remesh.hpp"
#include "remesh_surfaces.hpp"
#include "status.hpp"

namespace tetlod::test {

/// 6 x volume, in long double so that the check does not share the rounding of what it checks.
inline long double det(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  long double m[3][3];
  const Vec3 *ends[3] = {&b, &c, &d};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) m[i][k] = static_cast<long double>((*ends[i])[k]) - a[k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// All that a result has, in a row.
inline std::vector<char> bytes(const RemeshResult &result) {
  std::vector<char> all;
  const auto add = [&](const auto &array) {
    const char *data = reinterpret_cast<const char *>(array.data());
    all.insert(all.end(), data, data + array.size() * sizeof array[0]);
  };
  add(result.points);
  add(result.tets);
  add(result.origin);
  return all;
}

class Remesh : public testing::Test {
 protected:
  Memory memory;
  Parallel parallel{1};
  Job job{memory, parallel};
  Worker worker{TETLOD_REMESH};
  RemeshResult result{memory};

  Array<Vec3> no_samples() { return Array<Vec3>(&memory); }

  void run(const Surface &surface, const Array<Vec3> &samples) { remesh(surface, samples, worker, job, result); }

  Status status(const Surface &surface, const Array<Vec3> &samples) {
    try {
      run(surface, samples);
      return Status::ok;
    } catch (const Error &error) {
      message = error.what();
      return error.status();
    }
  }
  Status status(const Surface &surface) { return status(surface, no_samples()); }

  void expect_good(const Surface &surface, const Array<Vec3> &samples, long double relative_volume = 1e-9L) {
    const auto vertices = surface.points.size();
    ASSERT_GE(result.points.size(), vertices);
    ASSERT_EQ(result.points.size(), result.origin.size());
    std::int64_t steiner = 0, used_samples = 0;
    for (std::size_t i = 0; i < result.points.size(); i++) {
      const std::int32_t origin = result.origin[i];
      if (i < vertices) {
        ASSERT_EQ(origin, std::int32_t(i));
        ASSERT_EQ(0, std::memcmp(&result.points[i], &surface.points[i], sizeof(Vec3)));
      } else if (origin >= 0) {
        ASSERT_EQ(steiner, 0) << "samples come before Steiner points";
        ASSERT_EQ(0, std::memcmp(&result.points[i], &samples[std::size_t(origin) - vertices], sizeof(Vec3)));
        used_samples++;
      } else {
        steiner++;
      }
    }
    EXPECT_EQ(result.report.steiner_points, steiner);
    EXPECT_EQ(result.report.dropped_samples, std::int64_t(samples.size()) - used_samples);
    expect_faces(surface);
    expect_volume(surface, relative_volume);
  }

  void expect_faces(const Surface &surface) {
    std::map<std::array<std::int32_t, 3>, std::vector<Triangle>> faces;
    std::vector<bool> used(result.points.size());
    for (const Tet &tet : result.tets)
      for (std::size_t k = 0; k < 4; k++) {
        used[std::size_t(tet[k])] = true;
        const Triangle face = {tet[std::size_t(tet_face[k][0])], tet[std::size_t(tet_face[k][1])],
                               tet[std::size_t(tet_face[k][2])]};
        auto key = face;
        std::sort(key.begin(), key.end());
        faces[key].push_back(face);
      }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    std::set<Triangle> once, given;
    for (auto &[key, users] : faces) {
      ASSERT_LE(users.size(), 2u);
      if (users.size() == 1) once.insert(smallest_first(users[0]));
    }
    for (const Triangle &t : surface.triangles) given.insert(smallest_first(t));
    EXPECT_EQ(once, given);
  }

  static Triangle smallest_first(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }

  void expect_volume(const Surface &surface, long double relative_volume) {
    long double tets = 0, boundary = 0;
    const auto at = [&](std::int32_t i) { return result.points[std::size_t(i)]; };
    for (const Tet &t : result.tets) {
      const long double volume = det(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
      ASSERT_GT(volume, 0);
      tets += volume;
    }
    for (const Triangle &t : surface.triangles) boundary += det(surface.points[0], at(t[0]), at(t[1]), at(t[2]));
    EXPECT_NEAR(double(tets / boundary), 1, double(relative_volume));
  }

  std::string message;
};

}  // namespace tetlod::test
