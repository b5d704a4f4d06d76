// The command line.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

struct Arguments {
  std::string input, output;
  std::string field;                                  // empty: the filter's choice
  std::vector<std::pair<std::string, double>> steer;  // fields that steer, too, with their weights
  std::optional<int32_t> preset;                      // TETLOD_PRESET_*
  std::map<int32_t, double> numbers;                  // TETLOD_OPT_* that were given
  std::string report;                                 // empty: none
  std::string pictures;                               // a folder; empty: none
  bool quiet = false;
  std::string command;  // as it was typed
};

// Nothing when only help or the version was asked for; that is printed. Throws Failure for wrong usage.
std::optional<Arguments> parse_arguments(int argc, char **argv);

// Throws Failure where the run would overwrite one of the files that INPUT names as its parts.
void check_parts(const Arguments &arguments, const std::vector<std::string> &parts);

}  // namespace cli
