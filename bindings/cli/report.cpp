#include "report.hpp"

#include <cinttypes>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "failure.hpp"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

void put_counts(Json &json, const tetlod_run_report &run) {
  json["tets_in"] = run.tets_in;
  json["tets_out"] = run.tets_out;
  json["points_in"] = run.points_in;
  json["points_out"] = run.points_out;
  json["merged_points"] = run.merged_points;
  json["nonfinite_points"] = run.nonfinite_points;
  json["dropped_tets"] = run.dropped_tets;
  json["divided_tets"] = run.divided_tets;
  json["moved_points"] = run.moved_points;
  json["unused_points"] = run.unused_points;
  json["interior_points_in"] = run.interior_points_in;
  json["selected_samples"] = run.selected_samples;
  json["samples_outside"] = run.samples_outside;
  json["samples_too_near"] = run.samples_too_near;
  json["samples"] = run.samples;
  json["steiner_points"] = run.steiner_points;
  json["inserted_points"] = run.inserted_points;
  json["remesh_attempts"] = run.remesh_attempts;
  json["boundary_retries"] = run.boundary_retries;
}

void put_boundary(Json &json, const tetlod_run_report &run) {
  json["boundary_points_in"] = run.boundary_points_in;
  json["boundary_points_out"] = run.boundary_points_out;
  json["boundary_edges_in"] = run.boundary_edges_in;
  json["boundary_edges_out"] = run.boundary_edges_out;
  json["boundary_triangles_in"] = run.boundary_triangles_in;
  json["boundary_triangles_out"] = run.boundary_triangles_out;
  json["cleaned_edges"] = run.cleaned_edges;
  json["components"] = run.components;
  json["nonmanifold_edges"] = run.nonmanifold_edges;
  json["nonmanifold_points"] = run.nonmanifold_points;
  json["max_deviation"] = run.max_deviation;
}

// A number of JSON holds 53 bits for most readers, so the hash is a text.
std::string hexadecimal(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, hash);
  return text;
}

void put_resources(Json &json, const tetlod_run_report &run) {
  json["threads"] = run.threads;
  json["peak_bytes"] = run.peak_bytes;
  json["worker_peak_bytes"] = run.worker_peak_bytes;
  json["max_error"] = run.max_error;
  json["hash"] = hexadecimal(run.hash);
}

Json error_json(const tetlod_error_report &error) {
  return {{"rms", error.rms},
          {"max", error.max},
          {"outside", error.outside},
          {"samples_per_tet", error.samples_per_tet},
          {"rms_inner", error.rms_inner},
          {"max_inner", error.max_inner},
          {"outside_inner", error.outside_inner}};
}

Json seconds_json(const tetlod_run_report &run, const ToolSeconds &tool) {
  return {{"prepare", run.seconds_prepare}, {"boundary", run.seconds_boundary}, {"decimate", run.seconds_decimate},
          {"sample", run.seconds_sample},   {"cull", run.seconds_cull},         {"remesh", run.seconds_remesh},
          {"values", run.seconds_values},   {"total", run.seconds_total},       {"reading", tool.reading},
          {"writing", tool.writing},        {"measuring", tool.measuring},      {"pictures", tool.pictures}};
}

// Every option that the library has, as it was in effect.
Json options_json(const tetlod_context *context) {
  Json json = Json::object();
  for (int32_t option = 1; tetlod_option_name(option) != nullptr; option++) {
    double real = 0;
    int64_t integer = 0;
    const char *name = tetlod_option_name(option);
    if (tetlod_get_real(context, option, &real) == TETLOD_OK) {
      json[name] = real;
    } else if (tetlod_get_int(context, option, &integer) == TETLOD_OK) {
      json[name] = integer;
    }
  }
  return json;
}

}  // namespace

tetlod_run_report run_report(const tetlod_context *context) {
  tetlod_run_report run{};
  run.struct_size = sizeof run;
  check(tetlod_fetch_report(context, &run), context);
  return run;
}

void write_report(const OutputFile &file, const Arguments &arguments, const std::string &field,
                  const vtkTetlodSimplify &filter, const ToolSeconds &seconds) {
  const tetlod_context *context = filter.GetContext();
  const tetlod_run_report run = run_report(context);
  Json json = {{"tetlod", tetlod_build_info()},
               {"command", arguments.command},
               {"input", arguments.input},
               {"output", arguments.output},
               {"field", field},
               {"scalar_min", run.scalar_min},
               {"scalar_max", run.scalar_max}};
  json["steering"] = Json::object();  // beside the field, with weights
  for (const auto &[name, weight] : arguments.steer) json["steering"][name] = weight;
  json["options"] = options_json(context);
  put_counts(json, run);
  put_boundary(json, run);
  put_resources(json, run);
  json["error"] = error_json(filter.GetErrorReport());
  json["seconds"] = seconds_json(run, seconds);
  // File names are bytes; what is not UTF-8 in them is replaced instead of thrown about.
  file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace cli
