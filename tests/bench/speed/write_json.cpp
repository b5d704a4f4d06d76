#include "write_json.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bench {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Spread &spread) {
  return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}};
}

Json json_of(const FieldError &error) {
  return {{"rms", error.rms},
          {"max", error.max},
          {"outside", error.outside},
          {"rms_inner", error.rms_inner},
          {"max_inner", error.max_inner},
          {"outside_inner", error.outside_inner}};
}

Json json_of(const Side &side) {
  return {{"tets_out", side.tets_out},
          {"wall", json_of(side.wall)},
          {"cpu", json_of(side.cpu)},
          {"rms", json_of(side.rms)},
          {"error", json_of(side.error)}};
}

Json stages_of(const tetlod_run_report &run) {
  return {{"prepare", run.seconds_prepare}, {"boundary", run.seconds_boundary}, {"decimate", run.seconds_decimate},
          {"sample", run.seconds_sample},   {"cull", run.seconds_cull},         {"remesh", run.seconds_remesh},
          {"values", run.seconds_values},   {"total", run.seconds_total}};
}

Json counts_of(const tetlod_run_report &run) {
  return {{"boundary_edges_in", run.boundary_edges_in},
          {"boundary_edges_out", run.boundary_edges_out},
          {"selected_samples", run.selected_samples},
          {"samples_outside", run.samples_outside},
          {"samples_too_near", run.samples_too_near},
          {"steiner_points", run.steiner_points},
          {"points_out", run.points_out},
          {"remesh_attempts", run.remesh_attempts},
          {"peak_bytes", run.peak_bytes},
          {"worker_peak_bytes", run.worker_peak_bytes}};
}

Json json_of(const Parameters &p) {
  Json json = {{"preset", preset_name(p.preset)}, {"threads", p.threads}};
  if (p.preset == TETLOD_PRESET_PAPER) {
    json["rho"] = p.rho;
    json["sigma"] = p.sigma;
  } else {
    json["target"] = p.target;
  }
  return json;
}

Json json_of(const Contest &contest) {
  Json json = {{"name", contest.name},
               {"points_in", contest.points_in},
               {"tets_in", contest.tets_in},
               {"parameters", json_of(contest.parameters)},
               {"rounds", contest.rounds},
               {"tetlod", json_of(contest.tetlod)},
               {"seconds", stages_of(contest.report)},
               {"stage_cpu", contest.stage_cpu},
               {"counts", counts_of(contest.report)},
               {"bytes_in_all", bytes_in_all(contest)}};
  if (!contest.peer) return json;
  json["peer"] = json_of(*contest.peer);
  json["wall_speedup"] = json_of(contest.wall_speedup);
  json["cpu_speedup"] = json_of(contest.cpu_speedup);
  return json;
}

Json json_of(const std::vector<Contest> &contests) {
  Json list = Json::array();
  for (const Contest &contest : contests) list.push_back(json_of(contest));
  return list;
}

Json json_of(const Duel &duel) {
  Json json = {{"task", duel.task}, {"set", duel.set}, {"rival", duel.rival}};
  if (!duel.skipped.empty()) {
    json["skipped"] = duel.skipped;
    return json;
  }
  json["cpu"] = json_of(duel.cpu);
  json["wall"] = json_of(duel.wall);
  json["rival_cpu"] = json_of(duel.rival_cpu);
  json["rival_wall"] = json_of(duel.rival_wall);
  json["cpu_speedup"] = json_of(duel.cpu_speedup);
  json["wall_speedup"] = json_of(duel.wall_speedup);
  return json;
}

Json json_of(const std::vector<Duel> &duels) {
  Json list = Json::array();
  for (const Duel &duel : duels) list.push_back(json_of(duel));
  return list;
}

Json json_of(const std::vector<FreshContest> &contests) {
  Json list = Json::array();
  for (const FreshContest &contest : contests) {
    Json runs = Json::array();
    for (const FreshRuns &run : contest.runs) {
      runs.push_back({{"preset", preset_name(run.preset)}, {"threads", run.threads}, {"wall", json_of(run.wall)}});
    }
    list.push_back({{"set", contest.set},
                    {"tets_in", contest.tets_in},
                    {"target", contest.target},
                    {"peer_wall", json_of(contest.peer)},
                    {"runs", runs}});
  }
  return list;
}

}  // namespace

void write_json(const std::string &path, const std::vector<Contest> &contests, const std::vector<Duel> &duels,
                const std::optional<Growth> &growth, const std::vector<FreshContest> &fresh) {
  Json json = {{"tetlod", tetlod_build_info()}, {"contests", json_of(contests)}, {"duels", json_of(duels)}};
  if (growth) {
    json["growth"] = {{"sizes", json_of(growth->sizes)},
                      {"tetlod_exponent", growth->tetlod_exponent},
                      {"peer_exponent", growth->peer_exponent}};
  }
  if (!fresh.empty()) json["fresh"] = json_of(fresh);
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace bench
