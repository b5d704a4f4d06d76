// tetlod beside VTK's edge collapse: the blunt fin, a generated mesh, and how both grow. Prints tables.
//
// Nothing here is compared with stored seconds: machines differ. What is compared is the two, in one process, in turns.
#include <CLI/CLI.hpp>
#include <exception>
#include <limits>

#include "print_tables.hpp"
#include "write_json.hpp"

namespace {

struct Arguments {
  // Chosen for the least RMS at the paper's 9 % of the tets.
  double rho = 0.11, sigma = 0.575;
  std::string file;
  std::int64_t tets = 300000;
  double generated_rho = 0.06, generated_sigma = 0.3, time = 0.5;
  std::vector<std::int64_t> sizes{100000, 300000, 1000000};
  int rounds = 3;
  std::int64_t threads = 1;
  double ratio_limit = std::numeric_limits<double>::infinity();
  std::string json;
  bool no_growth = false;
};

void add_options(CLI::App &app, Arguments &a) {
  const CLI::Range positive(std::int64_t{48}, std::int64_t{100000000});
  app.add_option("--rho", a.rho, "of the blunt fin or of --file")->capture_default_str();
  app.add_option("--sigma", a.sigma, "of the blunt fin or of --file")->capture_default_str();
  app.add_option("--file", a.file, "a .vtu file instead of the blunt fin")->type_name("FILE");
  app.add_option("--tets", a.tets, "size of the generated mesh")->check(positive)->capture_default_str();
  app.add_option("--generated-rho", a.generated_rho, "of the generated meshes; growth: of its first size")
      ->capture_default_str();
  app.add_option("--generated-sigma", a.generated_sigma, "of the generated meshes")->capture_default_str();
  app.add_option("--time", a.time, "where the generated front stands, 0 to 1")->capture_default_str();
  app.add_option("--growth", a.sizes, "sizes of the growth table")->check(positive)->delimiter(',');
  app.add_flag("--no-growth", a.no_growth, "no growth table");
  app.add_option("--rounds", a.rounds, "of which medians are taken")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", a.threads, "of tetlod, 0: one a core; the peer has one")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--ratio-limit", a.ratio_limit, "fails when tetlod takes more than this times the peer's seconds")
      ->type_name("X");
  app.add_option("--json", a.json, "writes all figures there too")->type_name("FILE");
}

std::optional<std::string> real_mesh(const Arguments &a) {
  if (!a.file.empty()) return a.file;
  return bench::find_data("bluntfin.vtu");
}

void contest(const std::string &name, const bench::Mesh &mesh, const bench::Parameters &parameters, int rounds,
             std::vector<bench::Contest> &contests) {
  contests.push_back(bench::hold_contest(name, mesh, parameters, rounds));
  bench::print_contest(stdout, contests.back());
}

void contest_on_real_mesh(const Arguments &a, std::vector<bench::Contest> &contests) {
  const std::optional<std::string> path = real_mesh(a);
  if (!path) {
    std::printf("\nblunt fin: skipped, there is no bluntfin.vtu in TETLOD_DATA_DIR or in ../shared/data\n");
    return;
  }
  contest(a.file.empty() ? "blunt fin" : a.file, bench::read_mesh(*path), {a.rho, a.sigma, a.threads}, a.rounds,
          contests);
}

void contest_on_generated_mesh(const Arguments &a, std::vector<bench::Contest> &contests) {
  contest("generated front", bench::make_front_mesh(a.tets, a.time), {a.generated_rho, a.generated_sigma, a.threads},
          a.rounds, contests);
}

std::optional<bench::Growth> growth(const Arguments &a) {
  if (a.no_growth || a.sizes.empty()) return std::nullopt;
  const bench::Parameters first{a.generated_rho, a.generated_sigma, a.threads};
  const bench::Growth measured = bench::measure_growth(a.sizes, a.time, first, a.rounds);
  bench::print_growth(stdout, measured);
  return measured;
}

// 0 when tetlod kept within the limit on every mesh.
int judged(const std::vector<bench::Contest> &contests, double limit) {
  int status = EXIT_SUCCESS;
  for (const bench::Contest &contest : contests) {
    if (contest.ratio.median <= limit) continue;
    std::fprintf(stderr, "tetlod_bench: %s: %.3f times the peer's seconds, more than %.3f\n", contest.name.c_str(),
                 contest.ratio.median, limit);
    status = EXIT_FAILURE;
  }
  return status;
}

int run(const Arguments &a) {
  std::vector<bench::Contest> contests;
  bench::print_head(stdout);
  contest_on_real_mesh(a, contests);
  contest_on_generated_mesh(a, contests);
  const std::optional<bench::Growth> grown = growth(a);
  if (!a.json.empty()) bench::write_json(a.json, contests, grown);
  return judged(contests, a.ratio_limit);
}

}  // namespace

int main(int argc, char **argv) {
  Arguments arguments;
  CLI::App app("tetlod beside VTK's edge collapse, in one process, in turns.", "tetlod_bench");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(arguments);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "tetlod_bench: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
