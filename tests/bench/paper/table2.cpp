#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "outcome.hpp"
#include "published.hpp"
#include "tables.hpp"

namespace bench {
namespace {

// The paper's parameters for a set in hand.
struct Trial {
  const char *name;
  double sigma, rho;
};
constexpr Trial kTrials[] = {
    {"bluntfin_x8", 0.10, 0.010}, {"bluntfin", 0.05, 0.010}, {"bluntfin", 0.05, 0.100}, {"comb", 0.10, 0.005}};

published::Pipeline column_of(const char *name, const Trial &trial, double reading, const TetlodRun &made) {
  const tetlod_run_report &run = made.report;
  const StageSeconds &cpu = made.stage_cpu;  // prepare, boundary, decimate, sample, cull, remesh, values
  published::Pipeline column{};
  column.set = name;
  column.sigma = trial.sigma;
  column.rho = trial.rho;
  column.tets = double(run.tets_in);
  column.kept = double(run.tets_out) / double(run.tets_in);
  column.points = double(run.points_in);
  column.samples = double(run.selected_samples);
  column.final_points = double(run.points_out);
  column.steiner = double(run.steiner_points) / double(run.points_out);
  column.megabytes = 1e-6 * double(run.peak_bytes + run.worker_peak_bytes);
  column.reading = reading;
  column.boundary = cpu[1];
  column.decimate = cpu[2];
  column.sample = cpu[3];
  column.cull = cpu[4];
  column.remesh = cpu[5];
  column.values = cpu[6];
  const double stages = column.boundary + column.decimate + column.sample + column.cull + column.remesh + column.values;
  column.other = made.cost.cpu - stages;
  column.total = made.cost.cpu + reading;
  return column;
}

std::vector<published::Pipeline> measured_columns() {
  std::vector<published::Pipeline> columns;
  for (const Trial &trial : kTrials) {
    const auto path = find_data(std::string(trial.name) + ".vtu");
    if (!path) continue;
    std::fprintf(stderr, "Table 2: %s\n", trial.name);
    const Stopwatch reading;
    const Mesh mesh = read_mesh(*path);
    const double seconds = reading.cost().cpu;
    Parameters parameters;
    parameters.sigma = trial.sigma;
    parameters.rho = trial.rho;
    columns.push_back(column_of(trial.name, trial, seconds, run_tetlod(mesh, parameters)));
  }
  return columns;
}

struct Row {
  const char *name, *format;
  double published::Pipeline::*figure;
  double factor;
};

constexpr Row kRows[] = {
    {"boundary LOD, % of edges", "%.0f", &published::Pipeline::sigma, 100},
    {"clustering, % of range", "%.1f", &published::Pipeline::rho, 100},
    {"original tets", "%.0f", &published::Pipeline::tets, 1},
    {"tets kept, %", "%.1f", &published::Pipeline::kept, 100},
    {"original vertices", "%.0f", &published::Pipeline::points, 1},
    {"selected samples", "%.0f", &published::Pipeline::samples, 1},
    {"final vertices", "%.0f", &published::Pipeline::final_points, 1},
    {"Steiner points, % of them", "%.0f", &published::Pipeline::steiner, 100},
    {"memory, MB", "%.0f", &published::Pipeline::megabytes, 1},
    {"reading mesh, s", "%.2f", &published::Pipeline::reading, 1},
    {"extracting boundary, s", "%.2f", &published::Pipeline::boundary, 1},
    {"simplifying boundary, s", "%.2f", &published::Pipeline::decimate, 1},
    {"sampling points, s", "%.2f", &published::Pipeline::sample, 1},
    {"removing samples, s", "%.2f", &published::Pipeline::cull, 1},
    {"CDT, s", "%.2f", &published::Pipeline::remesh, 1},
    {"Steiner scalar field, s", "%.2f", &published::Pipeline::values, 1},
    {"other, s", "%.2f", &published::Pipeline::other, 1},
    {"total, s", "%.2f", &published::Pipeline::total, 1},
};

void for_each_column(const std::vector<published::Pipeline> &measured,
                     const std::function<void(const char *, const published::Pipeline &)> &use) {
  for (const published::Pipeline &column : published::kTable2) use("the paper: ", column);
  for (const published::Pipeline &column : measured) use("", column);
}

}  // namespace

void print_table2(std::FILE *to) {
  const std::vector<published::Pipeline> measured = measured_columns();
  std::string line = "|---|";
  std::fprintf(to, "| |");
  for_each_column(measured, [&](const char *of, const published::Pipeline &column) {
    std::fprintf(to, " %s%s |", of, column.set);
    line += "---|";
  });
  std::fprintf(to, "\n%s\n", line.c_str());
  for (const Row &row : kRows) {
    std::fprintf(to, "| %s |", row.name);
    for_each_column(measured, [&](const char *, const published::Pipeline &column) {
      std::fputc(' ', to);
      std::fprintf(to, row.format, row.factor * column.*row.figure);
      std::fputs(" |", to);
    });
    std::fputc('\n', to);
  }
}

}  // namespace bench
