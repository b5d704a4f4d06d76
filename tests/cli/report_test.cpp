// What the tool prints of a run, and the report's names, which others read.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "mesh_file.hpp"
#include "tool.hpp"

namespace cli_test {
namespace {

using Json = nlohmann::json;

class Report : public testing::Test {
 protected:
  Outcome run(std::vector<std::string> more = {}, const Cube &cube = {}) {
    write_cube(folder / "in.vtk", cube);
    more.insert(more.begin(), {folder / "in.vtk", folder / "out.vtu", "--report", folder / "report.json"});
    const Outcome outcome = run_tool(more);
    std::ifstream file(folder / "report.json");
    json = Json::parse(file, nullptr, false);
    return outcome;
  }

  Folder folder;
  Json json;
};

TEST_F(Report, HasTheNamesThatAreDocumented) {
  ASSERT_EQ(run().status, 0);
  ASSERT_TRUE(json.is_object());
  for (const char *name : {"tets_in", "tets_out", "points_in", "points_out", "samples", "steiner_points",
                           "boundary_edges_in", "boundary_edges_out", "boundary_retries", "peak_bytes"}) {
    EXPECT_TRUE(json[name].is_number_integer()) << name;
  }
  for (const char *name : {"rms", "max", "outside"}) EXPECT_TRUE(json["error"][name].is_number()) << name;
  for (const char *name : {"boundary", "decimate", "sample", "cull", "remesh", "values", "total"}) {
    EXPECT_TRUE(json["seconds"][name].is_number()) << name;
  }
}

TEST_F(Report, CountsTheInput) {
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(json["tets_in"], 6 * 6 * 6 * 6);
  EXPECT_EQ(json["points_in"], 7 * 7 * 7);
  EXPECT_EQ(json["boundary_edges_in"], 6 * 6 * 6 * 3);
  EXPECT_EQ(json["scalar_max"], 6.0);
  EXPECT_GE(json["seconds"]["total"], json["seconds"]["remesh"]);
}

TEST_F(Report, SaysThatPointsWereMoved) {
  Cube bent;
  bent.dent = 0.18;  // through the layer below
  const Outcome said = run({"--target-ratio", "0.5"}, bent);
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_GT(json["moved_points"], 0);
  EXPECT_NE(said.err.find("tets are turned over: " + json["moved_points"].dump() + " points are moved"),
            std::string::npos)
      << said.err;
  EXPECT_EQ(run({"--target-ratio", "0.5", "--on-overlap", "error"}, bent).status, 1);
  ASSERT_EQ(run({"--target-ratio", "0.5"}).status, 0);
  EXPECT_EQ(json["moved_points"], 0);
}

TEST_F(Report, OptionsAreThoseInEffect) {
  ASSERT_EQ(run({"--lambda", "0.3", "--rho", "0.02", "--seed", "7", "--preset", "paper"}).status, 0);
  EXPECT_EQ(json["options"]["rho"], 0.02);
  EXPECT_EQ(json["options"]["lambda"], 0.3) << "what is typed goes before the preset, wherever it stands";
  EXPECT_EQ(json["options"]["seed"], 7);
  EXPECT_NE(json["command"].get<std::string>().find("--rho 0.02"), std::string::npos);
  ASSERT_EQ(run({"--seed", "9007199254740992"}).status, 0) << "the largest that there is";
  EXPECT_EQ(json["options"]["seed"], 9007199254740992);
}

TEST_F(Report, NamesTheFieldsThatSteer) {
  ASSERT_EQ(run({"--steer", "other:0.5", "--target-ratio", "0.5"}).status, 0);
  EXPECT_EQ(json["field"], "heat");
  EXPECT_EQ(json["steering"], Json({{"other", 0.5}}));
  const std::string hash = json["hash"];
  ASSERT_EQ(run({"--steer", "other:0", "--target-ratio", "0.5"}).status, 0);
  EXPECT_NE(json["hash"], hash);
  const std::string riding = json["hash"];
  ASSERT_EQ(run({"--target-ratio", "0.5"}).status, 0);
  EXPECT_EQ(json["hash"], riding);
  EXPECT_EQ(json["steering"], Json::object());
}

TEST_F(Report, SteeringFieldsMayStandAnywhere) {
  const std::string in = folder / "in.vtk", out = folder / "out.vtu", report = folder / "report.json";
  const std::string first = "other:2", last = "flow:0.5";
  write_cube(in, {});
  const std::vector<std::string> orders[] = {{"--steer", first, "--steer", last, in, out},
                                             {"--steer", first, in, "--steer", last, out},
                                             {in, "--steer", first, out, "--steer", last},
                                             {in, out, "--steer", first, "--steer", last}};
  for (std::vector<std::string> words : orders) {
    words.insert(words.end(), {"--report", report});
    const Outcome outcome = run_tool(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream file(report);
    EXPECT_EQ(Json::parse(file, nullptr, false)["steering"], Json({{"other", 2.0}, {"flow", 0.5}}));
    std::filesystem::remove(report);
  }
}

TEST_F(Report, TableIsPrintedUnlessQuiet) {
  const Outcome loud = run(), quiet = run({"--quiet"});
  for (const char *row : {"Steiner points", "selected samples", "reading mesh", "CDT", "total (real)", "MB", "RMS",
                          "s to measure the error"}) {
    EXPECT_NE(loud.out.find(row), std::string::npos) << row;
  }
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(loud.err + quiet.err, "") << "no progress bar where there is no terminal";
}

TEST_F(Report, SameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(run({"--threads", "1"}).status, 0);
  const std::string hash = json["hash"], bytes = contents_of(folder / "out.vtu");
  ASSERT_EQ(run({"--threads", "2"}).status, 0);
  EXPECT_EQ(json["hash"], hash);
  EXPECT_EQ(contents_of(folder / "out.vtu"), bytes);
}

}  // namespace
}  // namespace cli_test
