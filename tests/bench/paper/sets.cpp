#include <cmath>
#include <string>

#include "outcome.hpp"
#include "tables.hpp"

namespace bench {
namespace {

constexpr double kKept = 0.1;
constexpr const char *kSets[] = {"bluntfin",       "bluntfin_raw",     "spx",          "spx_raw",      "comb",
                                 "bracket",        "disk_out_ref",     "fire",         "mug",          "notch_stress",
                                 "lv_active",      "cube_sphere_void", "cut_cylinder", "cad_exploded", "gmsh_piece",
                                 "microstructure", "slac_pic_nan",     "bluntfin_x8"};

std::string percent(double share, int digits) {
  if (!std::isfinite(share)) return "not measured";  // the set has values that are none
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %%", digits, 100 * share);
  return text;
}

std::string seconds(double cpu) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", cpu);
  return text;
}

// "10.0 %, volume 99.99 %, RMS 0.40 %, 7.4 % outside, 4.20 s", and what is wrong with it.
std::string told(const Outcome &outcome) {
  if (!outcome.done) return std::string("**none**: ") + outcome.why_not;
  std::string text = percent(outcome.kept, 1) + ", volume " + percent(outcome.volume, 1) + ", RMS " +
                     percent(outcome.error.rms, 2) + ", " + percent(outcome.error.outside, 0) + " outside, " +
                     seconds(outcome.cpu);
  if (outcome.kept > 1.1 * kKept) text = "**stops at** " + text;
  if (!outcome.valid) text += ", **not valid**";
  if (!outcome.same_topology) text += ", **topology lost**";
  return text;
}

}  // namespace

void print_sets(std::FILE *to, const PaperOptions &options) {
  std::fprintf(
      to, "| set, tets | edge collapse asked for %.0f %% | tetlod, `accurate`, asked for %.0f %% |\n|---|---|---|\n",
      100 * kKept, 100 * kKept);
  for (const std::string name : kSets) {
    const auto path = find_data(name + ".vtu");
    if (!path || (name == "bluntfin_x8" && !options.large)) continue;
    std::fprintf(stderr, "sets: %s\n", name.c_str());
    const Original original = original_of(name, *path);
    Parameters parameters;
    parameters.preset = TETLOD_PRESET_ACCURATE;
    parameters.target = kKept;
    const auto tets = std::int64_t(original.mesh.tets.size());
    const Outcome peer = run_peer_within(original, std::llround(kKept * double(tets)), options.peer_seconds);
    const Outcome ours = run_ours(original, parameters);
    std::fprintf(to, "| %s, %lld | %s | %s |\n", name.c_str(), (long long)tets, told(peer).c_str(), told(ours).c_str());
    std::fflush(to);
  }
}

}  // namespace bench
