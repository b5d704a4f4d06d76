// What a context takes over from its earlier runs is worth, and what it loses where it gives the same bytes up.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "loss.hpp"
#include "times.hpp"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> sets{"bluntfin_x8"};
  std::vector<std::string> presets{"paper", "fast", "accurate"};
  std::vector<std::string> parts{"steps", "warm", "levels", "transfer"};
};

void add_options(CLI::App &app, Arguments &a) {
  app.add_option("sets", a.sets, "names in TETLOD_DATA_DIR or ../shared/data, .vtu files, or front, of 200,000 tets")
      ->capture_default_str();
  app.add_option("--presets", a.presets, "of the runs")
      ->check(CLI::IsMember({"paper", "fast", "accurate"}))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--parts", a.parts,
                 "new values with the same bytes, warm starts, levels of detail, transfer; loss: of warm starts, over "
                 "all sets")
      ->check(CLI::IsMember({"steps", "warm", "levels", "transfer", "loss"}))
      ->delimiter(',')
      ->capture_default_str();
}

bool has(const std::vector<std::string> &items, const char *item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

std::optional<bench::Mesh> mesh_of(const std::string &set) {
  if (set == "front") return bench::make_front_mesh(200'000, 0.5);
  if (const std::optional<std::string> path = bench::find_set(set)) return bench::read_mesh(*path);
  return std::nullopt;
}

void measure_times(const Arguments &a, const bench::NamedMesh &mesh) {
  std::printf("%s, %zu tets\n", mesh.first.c_str(), mesh.second.tets.size());
  for (const std::string &preset : a.presets) {
    if (has(a.parts, "steps")) bench::measure_steps(mesh.second, preset);
    if (has(a.parts, "warm") && preset != "paper") bench::measure_warm_starts(mesh.second, preset);
    if (has(a.parts, "levels")) bench::measure_levels(mesh.second, preset);
    if (has(a.parts, "transfer")) bench::measure_transfer(mesh.second, preset);
  }
}

void measure(const Arguments &a) {
  std::vector<bench::NamedMesh> meshes;
  for (const std::string &set : a.sets)
    if (std::optional<bench::Mesh> mesh = mesh_of(set)) meshes.emplace_back(fs::path(set).stem(), std::move(*mesh));
  for (const bench::NamedMesh &mesh : meshes) measure_times(a, mesh);
  if (has(a.parts, "loss")) bench::measure_loss(meshes, a.presets);
}

}  // namespace

int main(int argc, char **argv) {
  Arguments arguments;
  CLI::App app("What tetlod takes over from one run to the next");
  add_options(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    measure(arguments);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_reuse: %s\n", error.what());
    return 1;
  }
}
