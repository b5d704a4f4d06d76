#include "print_tables.hpp"

#include <cinttypes>
#include <cstdlib>
#include <thread>

namespace bench {
namespace {

constexpr int kLabelWidth = 28, kColumnWidth = 22;

// 1234567 as 1,234,567.
std::string grouped(std::int64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string percent(double share) { return fixed(100 * share, 2) + " %"; }

std::string with_spread(const Spread &spread, double factor, int digits) {
  return fixed(factor * spread.median, digits) + " (" + fixed(factor * spread.least, digits) + ".." +
         fixed(factor * spread.most, digits) + ")";
}

void row(std::FILE *to, const std::string &label, const std::string &ours, const std::string &theirs) {
  std::fprintf(to, "  %-*s%*s%*s\n", kLabelWidth, label.c_str(), kColumnWidth, ours.c_str(), kColumnWidth,
               theirs.c_str());
}

// Of tetlod alone.
void row(std::FILE *to, const std::string &label, const std::string &ours) {
  std::fprintf(to, "  %-*s%*s\n", kLabelWidth, label.c_str(), kColumnWidth, ours.c_str());
}

// Of both; the peer's column is empty where it was not run.
template <class Figure>
void both(std::FILE *to, const Contest &c, const std::string &label, const Figure &figure) {
  row(to, label, figure(c.tetlod), c.peer ? figure(*c.peer) : "");
}

void print_sizes(std::FILE *to, const Contest &c) {
  both(to, c, "tets", [](const Side &side) { return grouped(side.tets_out); });
  both(to, c, "  share of the original's",
       [&c](const Side &side) { return percent(double(side.tets_out) / double(c.tets_in)); });
}

void print_seconds(std::FILE *to, const Contest &c) {
  both(to, c, "CPU seconds, median (range)", [](const Side &side) { return with_spread(side.cpu, 1, 3); });
  both(to, c, "wall seconds", [](const Side &side) { return with_spread(side.wall, 1, 3); });
  if (!c.peer) return;
  row(to, "times faster: CPU", with_spread(c.cpu_speedup, 1, 1), "1");
  row(to, "  wall", with_spread(c.wall_speedup, 1, 1), "1");
}

void print_errors(std::FILE *to, const Contest &c) {
  both(to, c, "RMS at vertices, % of range", [](const Side &side) { return with_spread(side.rms, 100, 2); });
  both(to, c, "  largest", [](const Side &side) { return percent(side.error.max); });
  both(to, c, "  vertices outside, ignored", [](const Side &side) { return percent(side.error.outside); });
  both(to, c, "RMS at points inside tets", [](const Side &side) { return percent(side.error.rms_inner); });
  both(to, c, "  largest", [](const Side &side) { return percent(side.error.max_inner); });
}

void print_counts(std::FILE *to, const tetlod_run_report &run) {
  row(to, "boundary edges", grouped(run.boundary_edges_in) + " to " + grouped(run.boundary_edges_out));
  row(to, "selected samples", grouped(run.selected_samples));
  row(to, "  outside, removed", grouped(run.samples_outside));
  row(to, "  too near, removed", grouped(run.samples_too_near));
  row(to, "Steiner points", grouped(run.steiner_points));
  row(to, "final vertices", grouped(run.points_out));
}

void print_stages(std::FILE *to, const Contest &c) {
  const tetlod_run_report &run = c.report;
  const double wall[kStages] = {run.seconds_prepare, run.seconds_boundary, run.seconds_decimate, run.seconds_sample,
                                run.seconds_cull,    run.seconds_remesh,   run.seconds_values};
  row(to, "seconds of stages", "CPU", "wall");
  for (std::size_t stage = 0; stage < kStages; stage++) {
    row(to, std::string("  ") + tetlod_stage_name(std::int32_t(stage)), fixed(c.stage_cpu[stage], 3),
        fixed(wall[stage], 3));
  }
}

void print_memory(std::FILE *to, const Contest &c) {
  const tetlod_run_report &run = c.report;
  row(to, "peak MB: in the host", fixed(double(run.peak_bytes) / 1e6, 1));
  row(to, "  bytes a tet of the original", fixed(double(run.peak_bytes) / double(c.tets_in), 1));
  row(to, "  in tetlod-remesh", fixed(double(run.worker_peak_bytes) / 1e6, 1));
}

std::string described(const Parameters &p) {
  const std::string preset = std::string("preset ") + preset_name(p.preset);
  if (p.preset != TETLOD_PRESET_PAPER) return preset + " at " + percent(p.target);
  return preset + ", rho " + fixed(p.rho, 3) + ", sigma " + fixed(p.sigma, 3);
}

std::string counted(std::int64_t threads) {
  return ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

std::string three(const Spread &speed) {
  char text[96];
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g", speed.least, speed.median, speed.most);
  return text;
}

void print_speed(std::FILE *to, const Duel &d) {
  std::fprintf(to, "| %-58s | %-16s | %-26s | ", d.task.c_str(), d.set.c_str(), d.rival.c_str());
  if (!d.skipped.empty()) {
    std::fprintf(to, "skipped: %s | | | |\n", d.skipped.c_str());
    return;
  }
  std::fprintf(to, "%9.1f | %9.1f | %24s | %24s |\n", 1e3 * d.cpu.median, 1e3 * d.rival_cpu.median,
               three(d.cpu_speedup).c_str(), three(d.wall_speedup).c_str());
}

}  // namespace

void print_head(std::FILE *to) {
  double load = 0;
  const unsigned cores = std::thread::hardware_concurrency();
  std::fprintf(to, "%s\n", tetlod_build_info());
  if (getloadavg(&load, 1) != 1) return;
  std::fprintf(to, "%u cores, load average %.1f%s\n", cores, load,
               load > 0.5 * cores ? ": other programs are running, seconds are not to be trusted" : "");
}

void print_contest(std::FILE *to, const Contest &c) {
  std::fprintf(to, "\n%s: %s tets, %s vertices; %s; %" PRId64 " thread%s; %d round%s\n", c.name.c_str(),
               grouped(c.tets_in).c_str(), grouped(c.points_in).c_str(), described(c.parameters).c_str(),
               c.parameters.threads, c.parameters.threads == 1 ? "" : "s", c.rounds, c.rounds == 1 ? "" : "s");
  row(to, "", "tetlod", "VTK's edge collapse");
  print_sizes(to, c);
  print_seconds(to, c);
  print_errors(to, c);
  print_counts(to, c.report);
  print_stages(to, c);
  print_memory(to, c);
  std::fflush(to);
}

void print_speeds(std::FILE *to, const std::vector<Contest> &contests, const std::vector<Duel> &duels) {
  if (contests.empty() && duels.empty()) return;
  std::fprintf(to, "\nTimes faster than others, least / median / most of the rounds\n\n");
  std::fprintf(to, "| %-58s | %-16s | %-26s | %9s | %9s | %24s | %24s |\n|---|---|---|---|---|---|---|\n", "task",
               "set", "rival", "CPU ms", "rival's", "times faster: CPU", "wall");
  for (const Contest &c : contests) {
    if (!c.peer) continue;
    print_speed(to, {described(c.parameters) + counted(c.parameters.threads), c.name, "VTK's edge collapse", "",
                     c.tetlod.cpu, c.tetlod.wall, c.peer->cpu, c.peer->wall, c.cpu_speedup, c.wall_speedup});
  }
  for (const Duel &duel : duels) print_speed(to, duel);
  std::fflush(to);
}

void print_fresh_head(std::FILE *to, const std::vector<std::int64_t> &threads) {
  std::string columns, rule;
  for (const std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    for (const std::int64_t n : threads) {
      columns += std::string(" | ") + preset_name(preset) + counted(n) + " | times faster";
      rule += "---|---|";
    }
  }
  std::fprintf(
      to,
      "\nIn new programs: wall seconds, the least of the rounds; times faster of the least, and of the medians\n\n");
  std::fprintf(to, "| set | tets | kept | the peer%s |\n|---|---|---|---|%s\n", columns.c_str(), rule.c_str());
}

void print_fresh(std::FILE *to, const FreshContest &c) {
  std::fprintf(to, "| %s | %s | %s | %.2f |", c.set.c_str(), grouped(c.tets_in).c_str(), percent(c.target).c_str(),
               c.peer.least);
  for (const FreshRuns &run : c.runs) {
    std::fprintf(to, " %.3f | %.1f (%.1f) |", run.wall.least, c.peer.least / run.wall.least,
                 c.peer.median / run.wall.median);
  }
  std::fprintf(to, "\n");
  std::fflush(to);
}

void print_growth(std::FILE *to, const Growth &growth) {
  std::fprintf(to, "\nGrowth on the generated front; seconds of the CPU and of the wall clock\n\n");
  std::fprintf(to,
               "| %12s | %7s | %10s | %9s | %9s | %9s | %11s | %9s | %10s |\n|---|---|---|---|---|---|---|---|---|\n",
               "tets", "kept", "tetlod CPU", "wall", "peer CPU", "wall", "bytes a tet", "in all MB", "tetlod RMS");
  for (const Contest &c : growth.sizes) {
    std::fprintf(to, "| %12s | %7s | %10.3f | %9.3f | %9s | %9s | %11.1f | %9.0f | %10s |\n",
                 grouped(c.tets_in).c_str(), percent(double(c.tetlod.tets_out) / double(c.tets_in)).c_str(),
                 c.tetlod.cpu.median, c.tetlod.wall.median, c.peer ? fixed(c.peer->cpu.median, 3).c_str() : "",
                 c.peer ? fixed(c.peer->wall.median, 3).c_str() : "", double(c.report.peak_bytes) / double(c.tets_in),
                 bytes_in_all(c) / 1e6, percent(c.tetlod.rms.median).c_str());
  }
  if (growth.sizes.size() < 2) return;
  std::fprintf(to, "\nThe least CPU seconds grow as tets to the power %.2f (tetlod)", growth.tetlod_exponent);
  if (growth.peer_exponent > 0) std::fprintf(to, " and %.2f (the peer)", growth.peer_exponent);
  std::fprintf(to, "\n");
}

}  // namespace bench
