// Partitions that are simplified alone, each with its interfaces locked, still fit: bit for bit.
#include <map>
#include <ostream>
#include <set>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

using Point = std::array<double, 3>;
using Face = std::array<std::int32_t, 3>;

/// A part of a mesh with points of its own.
struct Part {
  Cube mesh{0};
  std::vector<std::uint8_t> flags;
};

struct Joined {
  std::vector<Point> points;
  std::vector<double> values;
  std::vector<std::int32_t> corners;
};

int part_of(const Cube &cube, std::size_t tet) {
  double middle[2] = {0, 0};
  for (int k = 0; k < 4; k++)
    for (std::size_t c = 0; c < 2; c++)
      middle[c] += cube.xyz[3 * std::size_t(cube.corners[4 * tet + std::size_t(k)]) + c];
  // The second cut runs along faces of tets, not along a plane.
  return (middle[0] > 2.2) + 2 * (middle[1] + 0.6 * middle[0] > 2.6);
}

struct Way {
  const char *name;
  void (*choose)(tetlod_context *);
};
void PrintTo(const Way &way, std::ostream *out) { *out << way.name; }

class Partitions : public testing::TestWithParam<Way> {
 protected:
  static constexpr int count = 4;
  Cube whole{8};
  std::array<Part, count> parts;
  std::array<Context, count> contexts;
  Joined joined;

  void split() {
    std::vector<std::set<int>> owners(whole.values.size());
    const std::size_t tets = whole.corners.size() / 4;
    for (std::size_t t = 0; t < tets; t++)
      for (std::size_t k = 0; k < 4; k++) owners[std::size_t(whole.corners[4 * t + k])].insert(part_of(whole, t));
    std::array<std::map<std::int32_t, std::int32_t>, count> number;
    for (Part &part : parts) part.mesh.xyz.clear(), part.mesh.values.clear(), part.mesh.corners.clear();
    for (std::size_t t = 0; t < tets; t++) {
      const auto p = std::size_t(part_of(whole, t));
      Part &part = parts[p];
      for (std::size_t k = 0; k < 4; k++) {
        const std::int32_t v = whole.corners[4 * t + k];
        const auto [at, is_new] = number[p].try_emplace(v, std::int32_t(part.flags.size()));
        part.mesh.corners.push_back(at->second);
        if (!is_new) continue;
        const double *const xyz = whole.xyz.data() + 3 * v;
        part.mesh.xyz.insert(part.mesh.xyz.end(), xyz, xyz + 3);
        part.mesh.values.push_back(whole.values[std::size_t(v)]);
        part.flags.push_back(owners[std::size_t(v)].size() > 1 ? TETLOD_FLAG_LOCK : 0);
      }
    }
  }

  void simplify_each() {
    for (std::size_t p = 0; p < count; p++) {
      contexts[p] = make_context();
      tetlod_context *const context = contexts[p].get();
      GetParam().choose(context);
      submit(context, parts[p].mesh);
      const tetlod_array flags = array_of(TETLOD_UINT8, parts[p].flags.size(), 1, parts[p].flags.data());
      ASSERT_EQ(tetlod_submit_point_flags(context, &flags), TETLOD_OK) << message_of(context);
      ASSERT_EQ(tetlod_run(context), TETLOD_OK) << message_of(context);
      std::int64_t tets = 0;
      tetlod_fetch_counts(context, nullptr, &tets, nullptr);
      EXPECT_LT(std::size_t(tets), parts[p].mesh.corners.size() / 4) << "part " << p;
    }
  }

  template <class T>
  static std::vector<T> viewed(tetlod_status (*view)(const tetlod_context *, tetlod_array *), const Context &context) {
    tetlod_array array{};
    array.struct_size = sizeof array;
    EXPECT_EQ(view(context.get(), &array), TETLOD_OK);
    const T *const first = static_cast<const T *>(array.data);
    return {first, first + array.tuples};
  }

  /// Points of several parts are one where all their bits are the same; that they are is what is tested.
  void join() {
    std::map<Point, std::int32_t> number;
    for (const Context &context : contexts) {
      const std::vector<Point> points = viewed<Point>(tetlod_view_points, context);
      const std::vector<double> values = viewed<double>(tetlod_view_scalars, context);
      std::vector<std::int32_t> name;
      for (std::size_t v = 0; v < points.size(); v++) {
        const auto [at, is_new] = number.try_emplace(points[v], std::int32_t(joined.points.size()));
        name.push_back(at->second);
        if (is_new) {
          joined.points.push_back(points[v]);
          joined.values.push_back(values[v]);
        } else {
          EXPECT_EQ(joined.values[std::size_t(at->second)], values[v]) << "two values at one vertex of an interface";
        }
      }
      for (const auto &tet : viewed<std::array<std::int32_t, 4>>(tetlod_view_tets, context))
        for (std::int32_t v : tet) joined.corners.push_back(name[std::size_t(v)]);
    }
  }

  std::map<Face, int> faces_of_joined() const {
    std::map<Face, int> uses;
    for (std::size_t t = 0; t < joined.corners.size(); t += 4)
      for (std::size_t k = 0; k < 4; k++) {
        Face face{};
        for (std::size_t c = 0; c < 3; c++) face[c] = joined.corners[t + (k + 1 + c) % 4];
        std::sort(face.begin(), face.end());
        uses[face]++;
      }
    return uses;
  }

  /// The faces between the parts, as they were submitted, by the joined mesh's numbers; -1: a vertex is not there.
  std::set<Face> interfaces() const {
    std::map<Point, std::int32_t> number;
    for (std::size_t v = 0; v < joined.points.size(); v++) number[joined.points[v]] = std::int32_t(v);
    std::map<Face, std::set<int>> owners;
    for (std::size_t t = 0; t < whole.corners.size() / 4; t++)
      for (std::size_t k = 0; k < 4; k++) {
        Face face{};
        for (std::size_t c = 0; c < 3; c++) {
          const double *const xyz = whole.xyz.data() + 3 * whole.corners[4 * t + (k + 1 + c) % 4];
          const auto found = number.find({xyz[0], xyz[1], xyz[2]});
          face[c] = found == number.end() ? -1 - whole.corners[4 * t + (k + 1 + c) % 4] : found->second;
        }
        std::sort(face.begin(), face.end());
        owners[face].insert(part_of(whole, t));
      }
    std::set<Face> between;
    for (const auto &[face, parts_of_face] : owners)
      if (parts_of_face.size() == 2) between.insert(face);
    return between;
  }

  double volume() const {
    double sum = 0;
    for (std::size_t t = 0; t < joined.corners.size(); t += 4) {
      const auto at = [&](std::size_t k) { return joined.points[std::size_t(joined.corners[t + k])]; };
      double e[3][3];
      for (std::size_t k = 0; k < 3; k++)
        for (std::size_t c = 0; c < 3; c++) e[k][c] = at(k + 1)[c] - at(0)[c];
      sum += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
              e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
             6;
    }
    return sum;
  }

  /// What tetlod_check says of the whole: one solid without a defect, of which no two points are at one place.
  void expect_sound() {
    const Context judge = make_context();
    const std::size_t points = joined.points.size();
    const tetlod_array xyz = array_of(TETLOD_FLOAT64, points, 3, joined.points.data());
    const tetlod_array tets = array_of(TETLOD_INT32, joined.corners.size() / 4, 4, joined.corners.data());
    tetlod_submit_points(judge.get(), &xyz);
    tetlod_submit_tets(judge.get(), &tets, 0);
    tetlod_mesh_report report{};
    report.struct_size = sizeof report;
    ASSERT_EQ(tetlod_check(judge.get(), &report), TETLOD_OK);
    EXPECT_EQ(report.status, TETLOD_OK) << message_of(judge.get());
    EXPECT_EQ(report.components, 1);
    for (const tetlod_defect *defect :
         {&report.coincident, &report.flat, &report.inverted, &report.duplicate, &report.nonmanifold_faces,
          &report.overlapping, &report.unused, &report.nonmanifold_edges, &report.nonmanifold_points})
      EXPECT_EQ(defect->count, 0) << "defect " << defect - &report.index << " first at " << defect->first;
  }
};

TEST_P(Partitions, JoinToAConformingMesh) {
  split();
  for (const Part &part : parts) ASSERT_GT(part.mesh.corners.size(), 400u) << "the test's own parts";
  simplify_each();
  join();
  const std::map<Face, int> uses = faces_of_joined();
  for (const auto &[face, count_of_face] : uses) ASSERT_LE(count_of_face, 2) << face[0] << " " << face[1];
  const std::set<Face> between = interfaces();
  EXPECT_GT(between.size(), 200u);
  for (const Face &face : between) {
    ASSERT_GE(face[0], 0) << "an interface has lost vertex " << -1 - face[0];
    ASSERT_EQ(uses.count(face) ? uses.at(face) : 0, 2) << "an interface has lost a face";
  }
  EXPECT_NEAR(volume(), 1, 0.02);
  expect_sound();
}

void as_published(tetlod_context *context) {
  tetlod_set_sigma(context, 0.1);
  tetlod_set_rho(context, 0.3);
}
void fast(tetlod_context *context) {
  tetlod_set_preset(context, TETLOD_PRESET_FAST);
  tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, 0.4);
}
void sampled(tetlod_context *context) {
  fast(context);
  tetlod_set_real(context, TETLOD_OPT_CLEAN_EDGES, 1e-15);  // a small mesh is remeshed only so
}
void accurate(tetlod_context *context) {
  tetlod_set_preset(context, TETLOD_PRESET_ACCURATE);
  tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, 0.4);
}
void bounded(tetlod_context *context) { tetlod_set_real(context, TETLOD_OPT_MAX_ERROR, 0.02); }

INSTANTIATE_TEST_SUITE_P(Ways, Partitions,
                         testing::Values(Way{"published", as_published}, Way{"fast", fast}, Way{"sampled", sampled},
                                         Way{"accurate", accurate}, Way{"bounded", bounded}));

}  // namespace
}  // namespace tetlod_test
