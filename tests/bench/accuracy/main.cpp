// Error against size for each preset and VTK's edge collapse, on real sets: a table, a plot, and JSON.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "draw_plot.hpp"
#include "promises.hpp"
#include "steering.hpp"
#include "sweep_file.hpp"
#include "write_table.hpp"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> sets{"bluntfin", "comb", "spx", "disk_out_ref", "fire", "lv_active"};
  bench::SweepOptions sweep;
  std::string out = "out/accuracy", from;
  bool promises = false;
  bench::PromiseOptions promise;
  bool steering = false;
};

void add_options(CLI::App &app, Arguments &a) {
  app.add_option("sets", a.sets, "names in TETLOD_DATA_DIR or ../shared/data, or .vtu files")->capture_default_str();
  app.add_option("--sizes", a.sweep.sizes, "parts of the tets that are kept")
      ->delimiter(',')
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  app.add_option("--rounds", a.sweep.rounds, "of which medians are taken")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--threads", a.sweep.threads, "of tetlod, 0: one a core; the peer has one")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--out", a.out, "writes this name with .md, .svg and .json")->take_last()->capture_default_str();
  app.add_option("--judge", a.sweep.judge, "a program that is asked about the same results")
      ->envname("TETLOD_JUDGE")
      ->type_name("PROGRAM");
  app.add_flag("--promises", a.promises, "instead: are bounds of the error held and sizes met?");
  app.add_option("--bounds", a.promise.bounds, "of the error, parts of the range")->delimiter(',');
  app.add_option("--targets", a.promise.targets, "of the size, parts of the tets")->delimiter(',');
  app.add_flag("--steering", a.steering, "instead: what does a second field that steers cost the first?");
  app.add_option("--from", a.from, "measures nothing: table and plot of an earlier run's JSON")->type_name("FILE");
}

void write_markdown(const std::string &path, const std::vector<bench::Sweep> &sweeps) {
  std::FILE *const file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error(path + ": cannot be written");
  bench::write_table_head(file);
  for (const bench::Sweep &sweep : sweeps) bench::write_table(file, sweep);
  std::fclose(file);
}

// Whole after each set, so that a long run that is stopped leaves what it has.
void write_all(const Arguments &a, const std::vector<bench::Sweep> &sweeps) {
  if (a.from.empty()) bench::write_sweeps(a.out + ".json", sweeps, a.sweep);
  write_markdown(a.out + ".md", sweeps);
  bench::draw_plot(a.out + ".svg", sweeps);
}

// visit(name, mesh) for every set that is there.
template <class Visit>
void for_sets(const Arguments &a, const Visit &visit) {
  for (const std::string &set : a.sets) {
    if (const std::optional<std::string> path = bench::find_set(set))
      visit(fs::path(set).stem().string(), bench::read_mesh(*path));
  }
}

std::vector<bench::Sweep> measure(const Arguments &a) {
  std::vector<bench::Sweep> sweeps;
  for_sets(a, [&](const std::string &name, const bench::Mesh &mesh) {
    sweeps.push_back(bench::sweep_set(name, mesh, a.sweep));
    write_all(a, sweeps);
  });
  return sweeps;
}

// Fails when one is not kept.
int check_promises(const Arguments &a) {
  bool all_kept = true;
  bench::PromiseOptions options = a.promise;
  options.threads = a.sweep.threads;
  bench::write_promise_head(stdout);
  for_sets(a, [&](const std::string &name, const bench::Mesh &mesh) {
    for (const bench::Promise &promise : bench::measure_promises(mesh, options)) {
      bench::write_promise(stdout, name, promise);
      all_kept = all_kept && promise.is_kept;
    }
  });
  return all_kept ? EXIT_SUCCESS : EXIT_FAILURE;
}

void write_steering(const Arguments &a) {
  bench::SteeringOptions options;
  options.threads = a.sweep.threads;
  bench::write_steering_head(stdout);
  for_sets(a, [&](const std::string &name, const bench::Mesh &mesh) {
    for (const bench::Steering &row : bench::measure_steering(mesh, options)) bench::write_steering(stdout, name, row);
  });
}

void run(const Arguments &a) {
  if (fs::path(a.out).has_parent_path()) fs::create_directories(fs::path(a.out).parent_path());
  const std::vector<bench::Sweep> sweeps = a.from.empty() ? measure(a) : bench::read_sweeps(a.from);
  if (sweeps.empty()) throw std::runtime_error("nothing was measured");
  write_all(a, sweeps);
  bench::write_table_head(stdout);
  for (const bench::Sweep &sweep : sweeps) bench::write_table(stdout, sweep);
  std::printf("\nwritten: %s.md, .svg%s\n", a.out.c_str(), a.from.empty() ? ", .json" : "");
}

}  // namespace

int main(int argc, char **argv) {
  Arguments arguments;
  CLI::App app("Error against size: tetlod's presets and VTK's edge collapse.", "bench_accuracy");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    if (arguments.promises) return check_promises(arguments);
    arguments.steering ? write_steering(arguments) : run(arguments);
    return EXIT_SUCCESS;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_accuracy: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
