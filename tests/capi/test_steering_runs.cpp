// Several fields that steer: run after run, by several threads, cancelled, and where memory ends.
#include "steering_fixture.hpp"

namespace tetlod_test {
namespace {

class SteeringRuns : public Steering {
 protected:
  void submit_all(tetlod_context *of) {
    submit(of, cube);
    const tetlod_array array = array_of(TETLOD_FLOAT64, z.size(), 1, z.data());
    ASSERT_EQ(tetlod_submit_steering(of, "z", 2, &array), TETLOD_OK);
  }

  struct Outcome {
    std::vector<unsigned char> bytes;
    std::vector<double> z;
    bool operator==(const Outcome &o) const { return bytes == o.bytes && z == o.z; }
  };
  Outcome outcome() { return {bytes_of(context.get()), fetch("z", 1, points_out())}; }

  /// Of a context that has had no other run.
  Outcome fresh(double ratio) {
    Context other = make_context();
    context.swap(other);
    set_target(ratio);
    submit_all(context.get());
    run();
    const Outcome first = outcome();
    context.swap(other);
    return first;
  }

  void smaller_cube() {
    cube = Cube(4);
    x = cube.values = field_of(cube, 1, front_x);
    z = field_of(cube, 1, front_z);
    set_target(0.4);
    submit_all(context.get());
  }
};

TEST_F(SteeringRuns, EarlierRunsChangeNothing) {
  for (double ratio : {0.15, 0.0}) {
    set_target(ratio);
    for (double phase : {0.0, 0.3, 0.6}) {
      for (std::size_t v = 0; v < points(); v++) {
        cube.values[v] = x[v] + phase * cube.xyz[3 * v + 2];
        z[v] = front_z({cube.xyz[3 * v] + phase, cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]}, 0) + phase;
      }
      submit_all(context.get());
      run();
      EXPECT_TRUE(outcome() == fresh(ratio)) << ratio << " " << phase;
      EXPECT_EQ(report().reused_tets > 0, phase > 0 || ratio == 0);
      EXPECT_EQ(report().reused_triangles > 0, phase > 0 && ratio == 0) << "the paper's cost sees no field";
      run();
      EXPECT_EQ(report().reused_triangles > 0, ratio == 0) << "edges of tets collapse anew";
      ASSERT_EQ(steer("z", 1, z), TETLOD_OK);  // another weight is another boundary
      run();
      EXPECT_EQ(report().reused_triangles > 0, ratio == 0);
      ASSERT_EQ(carry("z", z, 1), TETLOD_OK);  // and none is yet another
      run();
      EXPECT_EQ(report().reused_triangles > 0, ratio == 0);
    }
  }
}

/// What collapses had in common with those for another weight is no part of it.
TEST_F(SteeringRuns, OfAnotherWeightChangeNothing) {
  cube = Cube(12);
  const std::vector<double> steep = field_of(cube, 1, [](const Point &p, int) { return std::tanh(9 * (p[2] - 0.4)); });
  const auto run_with = [&](tetlod_context *of, double weight) {
    submit(of, cube);
    const tetlod_array array = array_of(TETLOD_FLOAT64, steep.size(), 1, steep.data());
    EXPECT_EQ(tetlod_submit_steering(of, "steep", weight, &array), TETLOD_OK);
    EXPECT_EQ(tetlod_set_preset(of, TETLOD_PRESET_FAST), TETLOD_OK);
    EXPECT_EQ(tetlod_run(of), TETLOD_OK) << message_of(of);
    return bytes_of(of);
  };
  const Context used = make_context(), fresh = make_context();
  run_with(used.get(), 1);
  EXPECT_EQ(run_with(used.get(), 50), run_with(fresh.get(), 50));
}

TEST_F(SteeringRuns, ThreadsGiveTheSameBytes) {
  submit_all(context.get());
  run();
  const Outcome one = outcome();
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 2), TETLOD_OK);
  run();
  EXPECT_TRUE(outcome() == one);
}

TEST_F(SteeringRuns, ArraysOfAnyLayoutGiveTheSameBytes) {
  submit_all(context.get());
  for (double &value : z) value = double(float(value));
  run();
  const Outcome packed = outcome();
  std::vector<float> wide(3 * z.size(), 7);
  for (std::size_t v = 0; v < z.size(); v++) wide[3 * v + 1] = float(z[v]);
  tetlod_array array = array_of(TETLOD_FLOAT32, z.size(), 1, wide.data() + 1);
  array.tuple_stride = 3 * sizeof(float);
  ASSERT_EQ(tetlod_submit_steering(context.get(), "z", 2, &array), TETLOD_OK);
  run();
  EXPECT_TRUE(outcome() == packed);
}

TEST_F(SteeringRuns, TheStencilAndTheErrorNeedThemToBeThere) {
  submit_all(context.get());
  run();
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  ASSERT_EQ(tetlod_measure_error(context.get(), 0, &error), TETLOD_OK);
  // Vertices on the boundary may be inside for one and, by rounding, outside for the other.
  EXPECT_NEAR(error.rms, error_of(scalars(), x).rms, 0.1 * error.rms) << "the scalars' error";
  const auto moved = this->move(z, 1);
  EXPECT_EQ(moved.size(), points_out());
  const std::vector<double> other = z;
  ASSERT_EQ(steer("z", 2, other), TETLOD_OK);
  expect_failure(tetlod_measure_error(context.get(), 0, &error), TETLOD_ERR_STATE, "not submitted any more");
}

TEST_F(SteeringRuns, Cancelled) {
  submit_all(context.get());
  run();
  const Outcome kept = outcome();
  long polls = 0;
  struct Countdown {
    long left, calls;
  } countdown{-1, 0};
  const auto progress = [](void *user, std::int32_t, double) -> std::int32_t {
    auto &count = *static_cast<Countdown *>(user);
    count.calls++;
    return count.left >= 0 && count.left-- == 0;
  };
  ASSERT_EQ(tetlod_set_progress(context.get(), progress, &countdown), TETLOD_OK);
  run();
  polls = countdown.calls;
  ASSERT_GT(polls, 4);
  for (long n = 0; n < polls; n += 1 + polls / 8) {
    countdown.left = n;
    const tetlod_status status = tetlod_run(context.get());
    EXPECT_TRUE(status == TETLOD_ERR_CANCELLED || (status == TETLOD_OK && countdown.left >= 0)) << n;
    EXPECT_TRUE(outcome() == kept) << n;
  }
}

/// With what was kept of earlier runs, and without.
TEST_F(SteeringRuns, EveryHookedAllocation) {
  smaller_cube();
  run();
  const Outcome kept = outcome();
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  submit_all(context.get());
  const long failures = allocator.fail_each(
      context.get(), [&] { return tetlod_run(context.get()); }, [&](bool) { EXPECT_TRUE(outcome() == kept); }, 400);
  EXPECT_GT(failures, 100);
}

TEST_F(SteeringRuns, TheEstimateCountsThem) {
  std::uint64_t bare = 0, laden = 0;
  ASSERT_EQ(tetlod_estimate_memory(context.get(), &bare), TETLOD_OK);
  for (const char *name : {"a", "b", "c"}) ASSERT_EQ(steer(name, 1, z), TETLOD_OK);
  ASSERT_EQ(tetlod_estimate_memory(context.get(), &laden), TETLOD_OK);
  EXPECT_GT(laden, bare + 3 * 8 * points());
  run();
  EXPECT_LE(double(report().peak_bytes), 1.5 * double(laden));
  EXPECT_LE(double(laden), 1.5 * double(report().peak_bytes));
}

}  // namespace
}  // namespace tetlod_test
