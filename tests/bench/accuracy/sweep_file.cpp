#include "sweep_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tetlod.h"

namespace bench {

// The names are what the library looks for.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Spread, median, least, most)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FieldError, rms, max, outside, max_everywhere, rms_inner, max_inner, outside_inner)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Quality, field, hausdorff, volume, valid)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Entry, method, tets, quality, wall, cpu)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SizeRow, asked, entries)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Sweep, set, points, tets, rows)

void write_sweeps(const std::string &path, const std::vector<Sweep> &sweeps, const SweepOptions &options) {
  const nlohmann::json json = {
      {"tetlod", tetlod_build_info()}, {"rounds", options.rounds}, {"threads", options.threads}, {"sweeps", sweeps}};
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

std::vector<Sweep> read_sweeps(const std::string &path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  try {
    return nlohmann::json::parse(file).at("sweeps").get<std::vector<Sweep>>();
  } catch (const nlohmann::json::exception &error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace bench
