#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <vector>

#include "failure.hpp"
#include "output_file.hpp"
#include "tetlod.h"

namespace cli {
namespace {

struct NumberOption {
  const char *name;  // as the library knows it
  const char *help;
};

constexpr NumberOption kNumberOptions[] = {
    {"rho", "largest variation of the field in a cluster, fraction of its range"},
    {"sigma", "boundary edges kept, fraction of the original's"},
    {"lambda", "shape optimization weight of the boundary's triangles"},
    {"min-distance", "least distance of a sample to the boundary, fraction of the diagonal"},
    {"merge-tolerance", "points this near become one, fraction of the diagonal"},
    {"clean-edges", "boundary edges shorter than this are collapsed first, fraction of the diagonal"},
    {"target-ratio",
     "tets kept, fraction of the original's sound ones, with less error than the paper's method; 0: by rho and sigma"},
    {"effort", "with a target ratio or a largest error: 1 is fast, 2 accurate"},
    {"remesh", "0: by collapses alone, tetlod-remesh is never started; takes target-ratio or max-error"},
    {"max-error", "largest error allowed at the original vertices, fraction of the range; 0: no limit"},
    {"max-deviation", "largest distance allowed between the boundaries, fraction of the diagonal; 0: no limit"},
    {"threads", "how many at most; 0, the tool's default: one a core; the library's:"},
    {"seed", "of the points at which the error is measured"},
    {"time-limit", "seconds for the simplification, 0: none"},
};

// What happens to a defect of the mesh: the library's policies, by name.
constexpr NumberOption kPolicyOptions[] = {
    {"on-coincident", "points at one place: merged"},
    {"on-repeated", "tets with a vertex twice: dropped"},
    {"on-flat", "boundary tets without volume: dropped"},
    {"on-inverted", "tets the other way round: turned"},
    {"on-duplicate", "tets given twice: dropped"},
    {"on-overlap",
     "tets that overlap: points are moved until none is turned over, if that comes to an end; faces inside that do not "
     "fit: divided; parts in contact: each for itself"},
    {"on-unused", "points that no tet uses: ignored"},
    {"on-nonfinite", "points without a finite value: ignored with their tets (coordinates have to be finite)"},
};

tetlod_bounds bounds_of(int32_t option) {
  tetlod_bounds bounds{};
  bounds.struct_size = sizeof bounds;
  if (tetlod_option_bounds(option, &bounds) != TETLOD_OK) throw Failure("libtetlod does not know one of the options");
  return bounds;
}

// The library's own default, so that the help cannot tell another one.
std::string help_of(const NumberOption &option, const tetlod_bounds &bounds) {
  std::ostringstream text;
  text << option.help << " [" << bounds.preset << "]";
  return text.str();
}

// Compared as an integer: a double would round what is just beyond 2^53 into the bounds.
double within(const std::string &flag, int64_t value, const tetlod_bounds &bounds) {
  const auto least = static_cast<int64_t>(bounds.least), most = static_cast<int64_t>(bounds.most);
  if (least <= value && value <= most) return static_cast<double>(value);
  throw CLI::ValidationError(
      flag, std::to_string(value) + " is not in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
}

// What is empty is mostly a variable of a script that was not set.
std::string fault_if_empty(const std::string &text) { return text.empty() ? "an empty value" : ""; }

// The parser would take the next argument for the value that is not there.
void refuse_missing_values(const CLI::App &app, int argc, char **argv) {
  for (int i = 1; i < argc && std::string(argv[i]) != "--"; i++) {
    const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
    if (name + "=" == argument && app.get_option_no_throw(name) != nullptr)
      throw CLI::ValidationError(name, fault_if_empty(""));
  }
}

// Of an integer. The conversion takes 010 for 8, and the nearest that 64 bits hold for what they do not.
std::string fault_of_integer(const std::string &text) {
  const std::size_t first = text.find_first_not_of("+-");
  if (first < text.size() && text[first] == '0' && first + 1 < text.size()) return text + " begins with a 0";
  errno = 0;
  std::strtoll(text.c_str(), nullptr, 10);
  return errno == ERANGE ? text + " is out of range" : "";
}

void add_number(CLI::App &app, const NumberOption &option, Arguments &arguments) {
  const int32_t number = tetlod_option_from_name(option.name);
  const tetlod_bounds bounds = bounds_of(number);
  const std::string flag = std::string("--") + option.name, help = help_of(option, bounds);
  if (bounds.is_integer != 0) {
    const auto store = [number, flag, bounds, &arguments](const int64_t &value) {
      arguments.numbers[number] = within(flag, value, bounds);
    };
    app.add_option_function<int64_t>(flag, store, help)->type_name("N")->check(fault_of_integer);
  } else {
    const auto store = [number, &arguments](const double &value) { arguments.numbers[number] = value; };
    app.add_option_function<double>(flag, store, help)->type_name("X");
  }
}

void add_policy(CLI::App &app, const NumberOption &option, Arguments &arguments) {
  static const std::map<std::string, double> words{{"error", TETLOD_POLICY_ERROR}, {"repair", TETLOD_POLICY_REPAIR}};
  const int32_t number = tetlod_option_from_name(option.name);
  const bool repairs = bounds_of(number).preset == TETLOD_POLICY_REPAIR;
  const auto store = [number, &arguments](const std::string &word) { arguments.numbers[number] = words.at(word); };
  app.add_option_function<std::string>(std::string("--") + option.name, store,
                                       std::string(option.help) + (repairs ? " [repair]" : " [error]"))
      ->type_name("error|repair")
      ->check(CLI::IsMember({"error", "repair"}));
}

int32_t preset_named(const std::string &name) {
  static const std::map<std::string, int32_t> presets{
      {"paper", TETLOD_PRESET_PAPER}, {"fast", TETLOD_PRESET_FAST}, {"accurate", TETLOD_PRESET_ACCURATE}};
  if (const auto found = presets.find(name); found != presets.end()) return found->second;
  throw CLI::ValidationError("--preset", "there is no preset '" + name + "' (there are: paper, fast, accurate)");
}

// NAME or NAME:WEIGHT; a name may have colons of its own.
std::pair<std::string, double> weighted_name(const std::string &text) {
  const std::size_t colon = text.rfind(':');
  double weight = 1;
  if (colon == std::string::npos || !CLI::detail::lexical_cast(text.substr(colon + 1), weight)) return {text, 1};
  if (colon == 0) throw CLI::ValidationError("--steer", "'" + text + "' is a weight without a name");
  return {text.substr(0, colon), weight};
}

void add_steering(const std::string &text, Arguments &arguments) {
  const auto field = weighted_name(text);
  for (const auto &[name, weight] : arguments.steer)
    if (name == field.first) throw CLI::ValidationError("--steer", "field '" + name + "' is given twice");
  arguments.steer.push_back(field);
}

void add_options(CLI::App &app, Arguments &arguments) {
  app.add_option("INPUT", arguments.input, "the mesh: .vtu, .vtk or .pvtu")->required();
  app.add_option("OUTPUT", arguments.output, "the simplified mesh: .vtu, .vtk or .pvtu")->required();
  app.add_option("--field", arguments.field,
                 "point data that steers, vectors by their magnitude, cell data by their means [the active scalars, "
                 "else the first]")
      ->type_name("NAME");
  const auto steer = [&arguments](const std::vector<std::string> &fields) {
    for (const std::string &field : fields) add_steering(field, arguments);
  };
  app.add_option_function<std::vector<std::string>>("--steer", steer,
                                                    "further point data that steers, its errors times WEIGHT [1]; a "
                                                    "field that is named x:1 is x:1:1")
      ->type_name("NAME[:WEIGHT]")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);  // what follows is INPUT or OUTPUT
  const auto preset = [&arguments](const std::string &name) { arguments.preset = preset_named(name); };
  app.add_option_function<std::string>("--preset", preset,
                                       "sets the other options: paper, the default; fast or accurate, with a target "
                                       "ratio of 0.1 unless there is a largest error")
      ->type_name("NAME");
  for (const NumberOption &option : kNumberOptions) add_number(app, option, arguments);
  for (const NumberOption &option : kPolicyOptions) add_policy(app, option, arguments);
  app.add_option("--report", arguments.report, "writes what the run did as JSON")->type_name("FILE");
  app.add_option("--pictures", arguments.pictures, "writes pictures of both meshes and a report.html there")
      ->type_name("DIR");
  app.add_flag("--quiet", arguments.quiet, "prints errors only");
  const auto fault_if_option = [&app](const std::string &text) {
    const bool is_option =
        text.rfind("--", 0) == 0 && app.get_option_no_throw(text.substr(0, text.find('='))) != nullptr;
    return is_option ? "'" + text + "' is an option, no value" : "";
  };
  for (CLI::Option *option : app.get_options())
    if (option->get_expected_min() > 0) option->check(fault_if_empty)->check(fault_if_option);
}

std::string joined(int argc, char **argv) {
  std::string text;
  for (int i = 0; i < argc; i++) text += (i > 0 ? " " : "") + std::string(argv[i]);
  return text;
}

void check_endings(const Arguments &arguments) {
  for (const std::string &path : {arguments.input, arguments.output}) {
    const std::string ending = file_ending(path);
    if (ending != ".vtu" && ending != ".vtk" && ending != ".pvtu")
      throw Failure(path + ": not a .vtu, .vtk or .pvtu file", kWrongUsage);
  }
}

void check_piece(const Arguments &arguments) {
  const std::string piece = piece_of(arguments.output);
  if (!piece.empty() && same_file(piece, arguments.input))
    throw Failure(arguments.input + ": the piece of OUTPUT would take its place", kWrongUsage);
}

// Pictures are known by their ending, so that further ones are among them.
bool is_picture(const std::string &path, const std::string &folder) {
  const std::filesystem::path there = std::filesystem::path(folder) / std::filesystem::path(path).filename();
  const std::string ending = file_ending(path);
  return !folder.empty() && (ending == ".png" || ending == ".html") && same_file(path, there.string());
}

// What the report would overwrite; empty: nothing.
std::string overwritten_by_report(const Arguments &arguments) {
  const std::string &report = arguments.report;
  if (same_file(report, arguments.input)) return "INPUT";
  if (same_file(report, arguments.output)) return "OUTPUT";
  if (const std::string piece = piece_of(arguments.output); !piece.empty() && same_file(report, piece))
    return "the piece of OUTPUT";
  return is_picture(report, arguments.pictures) ? "one of the pictures" : "";
}

// Nothing but the table is printed.
void refuse_standard_output(const Arguments &arguments) {
  for (const std::string &path : {arguments.report, arguments.pictures})
    if (path == "-") throw Failure("-: names no file (./- does)", kWrongUsage);
}

void check_report(const Arguments &arguments) {
  if (arguments.report.empty()) return;
  const std::string lost = overwritten_by_report(arguments);
  if (!lost.empty()) throw Failure(arguments.report + ": --report would overwrite " + lost, kWrongUsage);
}

// Which of the run's files a part of INPUT is; empty: none.
std::string overwritten_by(const Arguments &arguments, const std::string &part) {
  const auto is_part = [&](const std::string &file) { return !file.empty() && same_file(part, file); };
  if (is_part(arguments.output) || is_part(piece_of(arguments.output))) return "OUTPUT";
  return is_part(arguments.report) ? "--report" : "";
}

// A link in the folder, which a picture may have the name of, to a file that is read or written.
void refuse_linked_pictures(const Arguments &arguments, const std::string &file) {
  std::error_code none;  // there is no such folder yet
  for (const auto &entry : std::filesystem::directory_iterator(arguments.pictures, none))
    if (entry.is_symlink(none) && same_file(entry.path().string(), file))
      throw Failure(entry.path().string() + ": --pictures would overwrite " + file, kWrongUsage);
}

// A folder, made with those around it, in the place of a file that is read or written.
void check_pictures(const Arguments &arguments) {
  using Path = std::filesystem::path;
  for (const std::string &file : {arguments.input, arguments.output, piece_of(arguments.output), arguments.report}) {
    if (file.empty()) continue;
    for (Path folder = arguments.pictures; !folder.empty() && folder != folder.parent_path();
         folder = folder.parent_path())
      if (same_file(folder.string(), file))
        throw Failure(arguments.pictures + ": --pictures would take the place of " + file, kWrongUsage);
    refuse_linked_pictures(arguments, file);
  }
}

}  // namespace

std::optional<Arguments> parse_arguments(int argc, char **argv) {
  Arguments arguments;
  arguments.command = joined(argc, argv);
  CLI::App app("Makes a tetrahedral mesh that carries a scalar field smaller.", "tetlod");
  app.set_version_flag("--version", std::string(tetlod_build_info()));
  add_options(app, arguments);
  try {
    refuse_missing_values(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::Success &asked) {
    app.exit(asked, std::cout, std::cerr);
    return std::nullopt;
  } catch (const CLI::ParseError &error) {
    throw Failure(std::string(error.what()) + " (see tetlod --help)", kWrongUsage);
  }
  check_endings(arguments);
  refuse_standard_output(arguments);
  check_piece(arguments);
  check_report(arguments);
  check_pictures(arguments);
  return arguments;
}

void check_parts(const Arguments &arguments, const std::vector<std::string> &parts) {
  for (const std::string &part : parts) {
    if (const std::string by = overwritten_by(arguments, part); !by.empty())
      throw Failure(part + ": " + by + " would overwrite a part of INPUT", kWrongUsage);
    refuse_linked_pictures(arguments, part);
  }
}

}  // namespace cli
