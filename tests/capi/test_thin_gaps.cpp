// Solids with thin gaps between them, which a coarse boundary would cross.
#include <cmath>
#include <string>

#include "reuse_fixture.hpp"

namespace tetlod_test {
namespace {

/// Nested plates of the same waves.
class ThinGaps : public Reuse {
 protected:
  ThinGaps() {
    const Cube plate(18);
    cube.xyz.clear();
    cube.values.clear();
    cube.corners.clear();
    for (int k = 0; k < plates; k++) add(plate, 0.1 * k);
    options.push_back([](tetlod_context *of) { tetlod_set_preset(of, TETLOD_PRESET_ACCURATE); });
  }

  void add(const Cube &plate, double height) {
    const auto first = std::int32_t(cube.values.size());
    for (std::size_t v = 0; v < plate.values.size(); v++) {
      const double x = plate.xyz[3 * v], y = plate.xyz[3 * v + 1];
      const double z = height + 0.06 * std::sin(9 * x) * std::sin(7 * y) + 0.09 * plate.xyz[3 * v + 2];
      cube.xyz.insert(cube.xyz.end(), {x, y, z});
      cube.values.push_back(std::sin(4 * x + 1) * std::cos(3 * y) + z * z);
    }
    for (std::int32_t v : plate.corners) cube.corners.push_back(first + v);
  }

  void ask_for(double ratio) {
    options.push_back([=](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, ratio); });
  }

  static constexpr int plates = 3;
};

struct Attempts {
  int more_careful = 0;
  static void count(void *user, std::int32_t, const char *message) {
    static_cast<Attempts *>(user)->more_careful += std::string(message).find("with more care") != std::string::npos;
  }
};

TEST_F(ThinGaps, AreKeptByCollapsesWithCare) {
  Attempts attempts;
  tetlod_set_log(context.get(), Attempts::count, &attempts, 0);
  ask_for(0.005);
  set_up(context.get());
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_GE(attempts.more_careful, 1) << "nothing crossed: the test looks at nothing";
  const tetlod_run_report report = report_of(context.get());
  EXPECT_EQ(report.remesh_attempts, 0);
  EXPECT_EQ(report.reused_collapses, 0);
  EXPECT_LE(double(report.tets_out), 1.03 * 0.005 * double(tets()));
  EXPECT_LE(report.max_deviation, 0.06);
}

TEST_F(ThinGaps, GiveTheSameBytesWithMoreThreadsAndAfterOtherSizes) {
  for (double ratio : {0.1, 0.005, 0.02, 0.005}) {
    ask_for(ratio);
    expect_fresh_bytes();
  }
  ask_for(0.005);
  options.push_back([](tetlod_context *of) { tetlod_set_int(of, TETLOD_OPT_THREADS, 2); });
  const Context threaded = make_context();
  set_up(threaded.get());
  ASSERT_EQ(tetlod_run(threaded.get()), TETLOD_OK) << message_of(threaded.get());
  EXPECT_EQ(bytes_of(threaded.get()), bytes_of(context.get()));
}

}  // namespace
}  // namespace tetlod_test
