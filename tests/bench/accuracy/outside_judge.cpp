#include "outside_judge.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "mesh_file.hpp"

namespace bench {
namespace {

std::string output_of(const std::string &command) {
  std::FILE *const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(command + ": cannot be run");
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), got);
  pclose(pipe);
  return text;
}

// Points that no tet uses are none of the mesh's: the peer leaves them.
Mesh without_unused_points(const Mesh &mesh) {
  std::vector<std::int32_t> place(mesh.points.size(), -1);
  Mesh kept;
  for (Tet tet : mesh.tets) {
    for (std::int32_t &corner : tet) {
      std::int32_t &at = place[std::size_t(corner)];
      if (at < 0) {
        at = std::int32_t(kept.points.size());
        kept.points.push_back(mesh.points[std::size_t(corner)]);
        kept.values.push_back(mesh.values[std::size_t(corner)]);
      }
      corner = at;
    }
    kept.tets.push_back(tet);
  }
  return kept;
}

}  // namespace

Quality ask_judge(const std::string &program, const Mesh &original, const Mesh &result) {
  const MeshOnDisk before(original, "_original.tet"), after(without_unused_points(result), "_result.tet");
  const std::string said = output_of("'" + program + "' '" + before.path() + "' '" + after.path() + "'");
  try {
    const nlohmann::json json = nlohmann::json::parse(said);
    const auto at = [&json](const char *name) { return json.at(name).get<double>(); };
    // max_all is that of vertices and samples together: there is no other figure for the two that it stands for.
    const FieldError field{at("rms"),       at("max"),     at("outside"),      at("max_all"),
                           at("rms_inner"), at("max_all"), at("outside_inner")};
    return {field, at("hausdorff"), at("volume"), json.at("valid").get<bool>()};
  } catch (const nlohmann::json::exception &error) {
    throw std::runtime_error(program + ": " + error.what());
  }
}

void print_agreement(const std::string &set, const Entry &entry, const Quality &theirs) {
  const Quality &ours = entry.quality;
  std::fprintf(stderr,
               "%s, %s, %lld tets, ours and the judge's: rms %.6f %.6f, rms_inner %.6f %.6f, max %.6f %.6f, outside "
               "%.6f %.6f, hausdorff %.6f %.6f, volume %.6f %.6f, valid %d %d\n",
               set.c_str(), entry.method.c_str(), static_cast<long long>(entry.tets), ours.field.rms, theirs.field.rms,
               ours.field.rms_inner, theirs.field.rms_inner, ours.field.max, theirs.field.max, ours.field.outside,
               theirs.field.outside, ours.hausdorff, theirs.hausdorff, ours.volume, theirs.volume, int(ours.valid),
               int(theirs.valid));
}

}  // namespace bench
