// The folder that --pictures makes: PNG files of a size that is known, and a page that needs nothing beside it.
#include <gtest/gtest.h>

#include "mesh_file.hpp"
#include "tool.hpp"

namespace cli_test {
namespace {

class Pictures : public testing::Test {
 protected:
  Outcome run(const Cube &cube, std::vector<std::string> more = {}) {
    write_cube(folder / "in.vtk", cube);
    more.insert(more.begin(), {folder / "in.vtk", folder / "out.vtu", "--quiet", "--pictures", folder / "pictures"});
    return run_tool(more);
  }
  std::string file(const std::string &name) const { return contents_of(folder / ("pictures/" + name)); }

  Folder folder;
};

unsigned big_endian(const std::string &bytes, std::size_t at) {
  unsigned number = 0;
  for (std::size_t k = 0; k < 4; k++) number = number << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return number;
}

std::size_t count_of(const std::string &text, const std::string &part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) count++;
  return count;
}

TEST_F(Pictures, AreWrittenOnLightAndOnDarkPaper) {
  const Outcome outcome = run({});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string name : {"surface", "isosurfaces", "volume", "slices", "histograms"}) {
    const std::string light = file(name + ".png"), dark = file(name + "-dark.png");
    ASSERT_GT(light.size(), 1000U) << name;
    EXPECT_EQ(light.substr(1, 3), "PNG");
    EXPECT_EQ(big_endian(light, 16), 1480U) << "the width in the file's head";
    EXPECT_EQ(big_endian(light, 20), big_endian(dark, 20));
    EXPECT_NE(light, dark);
  }
}

TEST_F(Pictures, TheReportNeedsNothingBesideIt) {
  ASSERT_EQ(run({}, {"--rho", "0.125"}).status, 0);
  const std::string page = file("report.html");
  EXPECT_EQ(count_of(page, "src=\"data:image/png;base64,"), 5U);
  EXPECT_EQ(count_of(page, "srcset=\"data:image/png;base64,"), 5U);
  EXPECT_EQ(count_of(page, "src="), 5U);
  EXPECT_EQ(count_of(page, "://"), 0U) << "no address";
  EXPECT_EQ(count_of(page, "<script"), 0U);
  for (const char *part : {"1,296 tets became", "--rho 0.125", "heat", "root mean square", "tetrahedralization"})
    EXPECT_GE(count_of(page, part), 1U) << part;
}

TEST_F(Pictures, TheSameRunMakesTheSamePictures) {
  ASSERT_EQ(run({}, {"--threads", "1"}).status, 0);
  const std::string first = file("slices.png") + file("surface.png");
  ASSERT_EQ(run({}, {"--threads", "2"}).status, 0);
  EXPECT_EQ(file("slices.png") + file("surface.png"), first);
}

TEST_F(Pictures, OtherCells) {
  Cube hexahedra;
  hexahedra.kind = Kind::hexahedron;
  const Outcome outcome = run(hexahedra);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(Pictures, AFolderThatCannotBeMade) {
  write_cube(folder / "in.vtk", {});
  write_cube(folder / "other.vtk", {});
  const auto run_with = [&](const std::string &pictures) {
    return run_tool(
        {folder / "in.vtk", folder / "out.vtu", "--report", folder / "run.json", "--pictures", folder / pictures});
  };
  const auto expect_nothing_done = [&](const Outcome &outcome, int status) {
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"in.vtk", "other.vtk"}));
  };
  expect_nothing_done(run_with("other.vtk/pictures"), 1);
  for (const char *in_the_way : {"in.vtk", "in.vtk/pictures", "out.vtu", "out.vtu/a/b", "run.json", "run.json/a"})
    expect_nothing_done(run_with(in_the_way), 2);
}

TEST_F(Pictures, ALinkToAFileOfTheRun) {
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", folder / "in.pvtu", "--sigma", "1"}).status, 0);
  const std::string pictures = folder / "pictures", link = folder / "pictures/report.html";
  std::filesystem::create_directory(pictures);
  for (const std::string file : {"in.pvtu", "in_0.vtu", "out.vtu"}) {
    std::filesystem::create_symlink(folder / file, link);
    const Outcome outcome = run_tool({folder / "in.pvtu", folder / "out.vtu", "--pictures", pictures});
    EXPECT_EQ(outcome.status, 2) << file;
    EXPECT_EQ(outcome.err, "tetlod: " + link + ": --pictures would overwrite " + (folder / file) + "\n");
    std::filesystem::remove(link);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.vtu"));
}

TEST_F(Pictures, APictureThatBecomesTooLarge) {
  write_cube(folder / "in.vtk", {});
  const std::string pictures = folder / "pictures";
  const Outcome outcome =
      run_tool_with_room({folder / "in.vtk", folder / "out.vtu", "--sigma", "0.1", "--pictures", pictures}, 20000);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err.rfind("tetlod: " + pictures + "/surface.png: cannot be written: ", 0), 0U) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(pictures));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.vtu"));
}

}  // namespace
}  // namespace cli_test
