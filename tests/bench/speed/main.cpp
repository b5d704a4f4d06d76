// The speed of tetlod beside others: VTK's edge collapse on whole runs, others on stages, what no run can go under, and
// how it grows. Prints tables.
//
// Nothing here is compared with stored seconds: machines differ. What is compared takes turns in one run.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <limits>

#include "boundary_duel.hpp"
#include "floor_duel.hpp"
#include "fresh_contest.hpp"
#include "kd_tree_duel.hpp"
#include "location_duel.hpp"
#include "print_tables.hpp"
#include "write_json.hpp"

namespace {

struct Arguments {
  std::string file;
  std::vector<double> file_targets{0.09};
  std::int64_t tets = 1000000;
  std::vector<double> targets{0.1, 0.02};
  bench::GrowthOptions growth;
  double growth_target = 0.01;
  std::vector<std::string> parts{"real", "generated", "stages", "growth"};
  int rounds = 3;
  std::vector<std::int64_t> threads{1, 2};
  double ratio_limit = std::numeric_limits<double>::infinity();
  std::string json;
};

void add_options(CLI::App &app, Arguments &a) {
  const CLI::Range positive(std::int64_t{48}, std::int64_t{100000000});
  const CLI::Range part(1e-6, 1.0);
  app.add_option("--file", a.file, "a .vtu file instead of the blunt fin")->type_name("FILE");
  app.add_option("--file-targets", a.file_targets, "parts of its tets that are kept")->check(part)->delimiter(',');
  app.add_option("--tets", a.tets, "size of the generated mesh")->check(positive)->capture_default_str();
  app.add_option("--targets", a.targets, "parts of its tets that are kept")->check(part)->delimiter(',');
  app.add_option("--time", a.growth.time, "where the generated front stands, 0 to 1")->capture_default_str();
  app.add_option("--growth", a.growth.tets, "sizes of the growth table")->check(positive)->delimiter(',');
  app.add_option("--growth-target", a.growth_target, "part of the tets kept there")->check(part)->capture_default_str();
  app.add_option("--peer-limit", a.growth.peer_limit, "tets beyond which growth goes without the peer")
      ->capture_default_str();
  app.add_option("--parts", a.parts,
                 "the real mesh, the generated one, duels about stages and floors, growth; fresh: new programs")
      ->check(CLI::IsMember({"real", "generated", "stages", "growth", "fresh"}))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--rounds", a.rounds, "of which medians are taken")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", a.threads, "of tetlod, in turn; 0: one a core; the peer has one")
      ->check(CLI::Range(0, 1024))
      ->delimiter(',');
  app.add_option("--ratio-limit", a.ratio_limit, "fails when tetlod takes more than this times the peer's CPU seconds")
      ->type_name("X");
  app.add_option("--json", a.json, "writes all figures there too")->type_name("FILE");
}

bench::Parameters fast_at(double target, std::int64_t threads) {
  bench::Parameters parameters;
  parameters.preset = TETLOD_PRESET_FAST;
  parameters.target = target;
  parameters.threads = threads;
  return parameters;
}

// As published; chosen for the least RMS at the paper's 9 % of the tets of the blunt fin.
bench::Parameters published(std::int64_t threads) {
  bench::Parameters parameters;
  parameters.rho = 0.11;
  parameters.sigma = 0.575;
  parameters.threads = threads;
  return parameters;
}

constexpr double kBoundaryKept = 0.1;  // part of the edges, of the duels about decimation

class Bench {
 public:
  explicit Bench(const Arguments &arguments) : a_(arguments) {}

  void run() {
    bench::print_head(stdout);
    if (wants("fresh")) in_new_programs();
    if (wants("real")) real_mesh();
    if (wants("generated")) generated_mesh();
    bench::print_speeds(stdout, contests_, duels_);
    if (wants("growth") && !a_.growth.tets.empty()) grow();
    if (!a_.json.empty()) bench::write_json(a_.json, contests_, duels_, growth_, fresh_);
  }

  // 0 when tetlod kept within the limit on every mesh.
  int judged() const {
    int status = EXIT_SUCCESS;
    for (const bench::Contest &contest : contests_) {
      const double ratio = 1 / contest.cpu_speedup.median;
      if (ratio <= a_.ratio_limit) continue;
      std::fprintf(stderr, "tetlod_bench: %s: %.3f times the peer's CPU seconds, more than %.3f\n",
                   contest.name.c_str(), ratio, a_.ratio_limit);
      status = EXIT_FAILURE;
    }
    return status;
  }

 private:
  bool wants(const char *part) const { return std::find(a_.parts.begin(), a_.parts.end(), part) != a_.parts.end(); }

  void contest(const std::string &name, const bench::Mesh &mesh, const bench::Parameters &parameters) {
    contests_.push_back(bench::hold_contest(name, mesh, parameters, a_.rounds, true));
    bench::print_contest(stdout, contests_.back());
  }

  // None, having said so: it is not there.
  static std::optional<bench::Mesh> read_data(const std::string &file) {
    const std::optional<std::string> path = bench::find_data(file);
    if (path) return bench::read_mesh(*path);
    std::printf("\nskipped: there is no %s in TETLOD_DATA_DIR or in ../shared/data\n", file.c_str());
    return std::nullopt;
  }

  std::optional<bench::Mesh> read_real_mesh() const {
    return a_.file.empty() ? read_data("bluntfin.vtu") : bench::read_mesh(a_.file);
  }
  std::string name_of_real_mesh() const { return a_.file.empty() ? "blunt fin" : a_.file; }

  void in_new_programs() {
    bench::print_fresh_head(stdout, a_.threads);
    if (const auto mesh = read_real_mesh()) fresh(name_of_real_mesh(), *mesh, a_.file_targets);
    if (const auto mesh = a_.file.empty() ? read_data("comb.vtu") : std::nullopt) {
      fresh("comb", *mesh, {a_.targets.front()});
      fresh("comb, each tet in eight", bench::refined(*mesh), a_.targets);
    }
    fresh("generated front", bench::make_front_mesh(a_.tets, a_.growth.time), a_.targets);
  }

  void fresh(const std::string &name, const bench::Mesh &mesh, const std::vector<double> &targets) {
    for (const double target : targets) {
      fresh_.push_back(bench::hold_fresh_contest(name, mesh, target, a_.threads, a_.rounds));
      bench::print_fresh(stdout, fresh_.back());
    }
  }

  void real_mesh() {
    const std::optional<bench::Mesh> read = read_real_mesh();
    if (!read) return;
    const bench::Mesh &mesh = *read;
    const std::string name = name_of_real_mesh();
    for (const std::int64_t threads : a_.threads) {
      for (const double target : a_.file_targets) contest(name, mesh, fast_at(target, threads));
    }
    if (a_.file.empty()) contest(name, mesh, published(a_.threads.front()));
    duels_about(name, mesh, a_.file_targets);
  }

  void generated_mesh() {
    const bench::Mesh mesh = bench::make_front_mesh(a_.tets, a_.growth.time);
    for (const std::int64_t threads : a_.threads) {
      for (const double target : a_.targets) contest("generated front", mesh, fast_at(target, threads));
    }
    duels_about("generated front", mesh, a_.targets);
  }

  void duels_about(const std::string &name, const bench::Mesh &mesh, const std::vector<double> &targets) {
    if (!wants("stages")) return;
    const std::int64_t threads = a_.threads.back();
    add(bench::hold_boundary_duels(name, mesh, kBoundaryKept, threads, a_.rounds));
    add(bench::hold_kd_tree_duels(name, mesh, a_.rounds));
    add(bench::hold_location_duels(name, mesh, targets.front(), threads, a_.rounds));
    for (const double target : targets) add(bench::hold_floor_duels(name, mesh, fast_at(target, threads), a_.rounds));
  }

  void add(const std::vector<bench::Duel> &duels) { duels_.insert(duels_.end(), duels.begin(), duels.end()); }

  void grow() {
    growth_ = bench::measure_growth(a_.growth, fast_at(a_.growth_target, a_.threads.back()), a_.rounds);
    bench::print_growth(stdout, *growth_);
  }

  const Arguments &a_;
  std::vector<bench::Contest> contests_;
  std::vector<bench::Duel> duels_;
  std::vector<bench::FreshContest> fresh_;
  std::optional<bench::Growth> growth_;
};

}  // namespace

int main(int argc, char **argv) {
  Arguments arguments;
  CLI::App app("The speed of tetlod beside others, in turns.", "tetlod_bench");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    Bench bench(arguments);
    bench.run();
    return bench.judged();
  } catch (const std::exception &error) {
    std::fprintf(stderr, "tetlod_bench: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
