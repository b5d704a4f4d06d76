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

void print_sizes(std::FILE *to, const Contest &c) {
  const double tets = double(c.tets_in);
  row(to, "tets", grouped(c.tetlod.tets_out), grouped(c.peer.tets_out));
  row(to, "  share of the original's", percent(double(c.tetlod.tets_out) / tets),
      percent(double(c.peer.tets_out) / tets));
}

void print_seconds(std::FILE *to, const Contest &c) {
  row(to, "seconds, median (range)", with_spread(c.tetlod.seconds, 1, 3), with_spread(c.peer.seconds, 1, 3));
  row(to, "  over the peer's", with_spread(c.ratio, 1, 3), "1");
}

void print_errors(std::FILE *to, const Contest &c) {
  row(to, "RMS at vertices, % of range", with_spread(c.tetlod.rms, 100, 2), with_spread(c.peer.rms, 100, 2));
  row(to, "  largest", percent(c.tetlod.error.max), percent(c.peer.error.max));
  row(to, "  vertices outside, ignored", percent(c.tetlod.error.outside), percent(c.peer.error.outside));
  row(to, "RMS at centroids of tets", percent(c.tetlod.error.rms_inner), percent(c.peer.error.rms_inner));
  row(to, "  largest", percent(c.tetlod.error.max_inner), percent(c.peer.error.max_inner));
}

void print_counts(std::FILE *to, const tetlod_run_report &run) {
  row(to, "boundary edges", grouped(run.boundary_edges_in) + " to " + grouped(run.boundary_edges_out));
  row(to, "selected samples", grouped(run.selected_samples));
  row(to, "  outside, removed", grouped(run.samples_outside));
  row(to, "  too near, removed", grouped(run.samples_too_near));
  row(to, "Steiner points", grouped(run.steiner_points));
  row(to, "final vertices", grouped(run.points_out));
}

void print_stages(std::FILE *to, const tetlod_run_report &run) {
  row(to, "seconds: preparing", fixed(run.seconds_prepare, 3));
  row(to, "  extracting boundary", fixed(run.seconds_boundary, 3));
  row(to, "  simplifying boundary", fixed(run.seconds_decimate, 3));
  row(to, "  sampling points", fixed(run.seconds_sample, 3));
  row(to, "  removing samples", fixed(run.seconds_cull, 3));
  row(to, "  CDT", fixed(run.seconds_remesh, 3));
  row(to, "  values of Steiner points", fixed(run.seconds_values, 3));
}

void print_memory(std::FILE *to, const tetlod_run_report &run) {
  row(to, "peak MB: in the host", fixed(double(run.peak_bytes) / 1e6, 1));
  row(to, "  in tetlod-remesh", fixed(double(run.worker_peak_bytes) / 1e6, 1));
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
  std::fprintf(to, "\n%s: %s tets, %s vertices; rho %g, sigma %g, preset paper; %" PRId64 " thread%s; %d round%s\n",
               c.name.c_str(), grouped(c.tets_in).c_str(), grouped(c.points_in).c_str(), c.parameters.rho,
               c.parameters.sigma, c.parameters.threads, c.parameters.threads == 1 ? "" : "s", c.rounds,
               c.rounds == 1 ? "" : "s");
  row(to, "", "tetlod", "VTK's edge collapse");
  print_sizes(to, c);
  print_seconds(to, c);
  print_errors(to, c);
  print_counts(to, c.report);
  print_stages(to, c.report);
  print_memory(to, c.report);
  std::fflush(to);
}

void print_growth(std::FILE *to, const Growth &growth) {
  std::fprintf(to, "\nGrowth on the generated front\n");
  std::fprintf(to, "  %12s %9s %9s %14s %14s %9s %12s %12s\n", "tets", "rho", "kept", "tetlod s", "peer s", "ratio",
               "tetlod RMS", "peer RMS");
  for (const Contest &c : growth.sizes) {
    std::fprintf(to, "  %12s %9.4f %9s %14.3f %14.3f %9.3f %12s %12s\n", grouped(c.tets_in).c_str(), c.parameters.rho,
                 percent(double(c.tetlod.tets_out) / double(c.tets_in)).c_str(), c.tetlod.seconds.median,
                 c.peer.seconds.median, c.ratio.median, percent(c.tetlod.rms.median).c_str(),
                 percent(c.peer.rms.median).c_str());
  }
  if (growth.sizes.size() < 2) return;
  std::fprintf(to, "  the least seconds grow as tets to the power %.2f (tetlod) and %.2f (the peer)\n",
               growth.tetlod_exponent, growth.peer_exponent);
}

}  // namespace bench
