// Wrong usage ends with status 2, everything else that fails with 1; either way one line on stderr, nothing on stdout
// and no file.
#include "usage.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

namespace cli_test {
namespace {

TEST_F(Usage, HelpAndVersionArePrinted) {
  const Outcome help = run_tool({"--help"}), version = run_tool({"--version"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("--min-distance"), std::string::npos);
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("tetlod ", 0), 0U);
  EXPECT_EQ(help.err + version.err, "");
}

TEST_F(Usage, WrongCommandLines) {
  const std::string in = folder / "in.vtk", out = folder / "out.vtu";
  write_cube(in, {});
  expect_failure(run_tool({}), 2, "INPUT");
  expect_failure(run_tool({in}), 2, "OUTPUT");
  expect_failure(run_tool({in, out, "--nonsense", "1"}), 2, "--nonsense");
  expect_failure(run_tool({in, out, "--rho", "many"}), 2, "--rho");
  expect_failure(run_tool({in, out, "--rho", "-1"}), 2, "rho");
  expect_failure(run_tool({in, out, "--rho", "nan"}), 2, "rho");
  expect_failure(run_tool({in, out, "--sigma", "1e9"}), 2, "sigma");
  expect_failure(run_tool({in, out, "--threads", "-3"}), 2, "threads");
  expect_failure(run_tool({in, out, "--threads", "1.5"}), 2, "--threads");
  for (const char *seed : {"-1", "9007199254740993", "9223372036854775807", "99999999999999999999"})
    expect_failure(run_tool({in, out, "--seed", seed}), 2, seed);
  for (const char *option : {"--target-ratio", "--threads", "--field", "--report", "--pictures", "--on-flat"})
    expect_failure(run_tool({in, out, option, ""}), 2, option);
  expect_failure(run_tool({in, out, "--preset", "none-such"}), 2, "none-such");
  for (const char *octal : {"010", "-08", "0x10"})
    expect_failure(run_tool({in, out, "--threads", octal}), 2, std::string(octal) + " begins with a 0");
  expect_failure(run_tool({in, out, "--remesh", "0"}), 2, "--remesh 0 takes");
  expect_failure(run_tool({in, out, "--steer", "other:-1"}), 2, "field other: weight -1");
  expect_failure(run_tool({in, out, "--steer", "other:nan"}), 2, "field other: weight nan");
  expect_failure(run_tool({in, out, "--steer", "a", "--steer", "b:2", "--steer", "c", "--steer", "d"}), 2,
                 "field d: 3 fields");
  expect_failure(run_tool({in, folder / "out.stl"}), 2, "out.stl");
  expect_failure(run_tool({folder / "in.stl", out}), 2, "in.stl");
  expect_only_input();
}

TEST_F(Usage, OptionsWithoutMeaningAndAMissedSizeAreNoted) {
  const Outcome usual = run_on({}, {"--target-ratio", "0.2"});
  EXPECT_EQ(usual.err, "");
  const Outcome unused = run_on({}, {"--target-ratio", "0.2", "--sigma", "0.5", "--rho", "0"});
  EXPECT_EQ(unused.status, 0);
  EXPECT_EQ(unused.err,
            "tetlod: note: --rho has no meaning with --target-ratio or --max-error\n"
            "tetlod: note: --sigma has no meaning with --target-ratio or --max-error\n");
  EXPECT_EQ(run_on({}, {"--effort", "1", "--max-deviation", "0.5"}).err,
            "tetlod: note: --effort has no meaning without --target-ratio or --max-error\n");
  EXPECT_NE(run_on({}, {"--preset", "fast", "--target-ratio", "0"}).err.find("--target-ratio 0"), std::string::npos);
  EXPECT_EQ(run_on({}, {"--rho", "0"}).err, "");
  const Outcome missed = run_on({}, {"--target-ratio", "0.0001"});
  EXPECT_EQ(missed.status, 0);
  EXPECT_NE(missed.err.find("note: a part of 0.0001 of the tets was asked for, and 0.0"), std::string::npos)
      << missed.err;
}

TEST_F(Usage, AFieldThatIsHardlyMeantIsNoted) {
  Cube cube;
  cube.hottest = 0;
  const std::string others = "; --field takes another: other, flow\n";
  EXPECT_EQ(run_on(cube, {"--target-ratio", "0.5"}).err,
            "tetlod: note: the field 'heat' is constant: shape alone decided" + others);
  cube.hottest = 6;
  cube.heat = "int";
  cube.size = 1;
  EXPECT_EQ(run_on(cube, {"--target-ratio", "1"}).err,
            "tetlod: note: the field 'heat' has whole numbers, as names of points do" + others);
  EXPECT_EQ(run_on(cube, {"--target-ratio", "1", "--field", "heat"}).err, "");
}

TEST_F(Usage, OfSeveralTimeStepsOneIsTaken) {
  const std::string in = folder / "in.vtu", out = folder / "out.vtu", grid = "<UnstructuredGrid";
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", in}).status, 0);
  std::string series = contents_of(in);
  std::ofstream(in, std::ios::binary) << series.insert(series.find(grid) + grid.size(), " TimeValues=\"0 1 2\"");
  const Outcome outcome = run_tool({in, out});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "tetlod: note: " + in + ": the first of 3 time steps is taken\n");
}

TEST_F(Usage, FilesThatCannotBeWritten) {
  write_cube(folder / "in.vtk", {});
  const std::string in = folder / "in.vtk";
  expect_failure(run_tool({in, folder / "no/such/out.vtu"}), 1, "out.vtu");
  expect_failure(run_tool({in, folder / "out.vtu", "--report", folder / "no/such/r.json"}), 1, "r.json");
  expect_only_input();
}

TEST_F(Usage, FilesThatAreProtected) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write to any file";
  std::ofstream(folder / "out.vtu") << "kept";
  std::filesystem::permissions(folder / "out.vtu", std::filesystem::perms::owner_read);
  expect_failure(run_on({}), 1, "out.vtu: cannot be written: Permission denied");
  EXPECT_EQ(contents_of(folder / "out.vtu"), "kept");
}

TEST_F(Usage, AReportDoesNotOverwriteTheRunsOtherFiles) {
  const std::string in = folder / "in.vtk", out = folder / "out.vtu";
  write_cube(in, {});
  const std::string whole = contents_of(in);
  std::filesystem::create_symlink("out.vtu", folder / "link");
  for (const char *report : {"out.vtu", "./out.vtu", "no/../out.vtu", "link"})
    expect_failure(run_tool({in, out, "--report", folder / report}), 2, "overwrite OUTPUT");
  expect_failure(run_tool({in, out, "--report", std::filesystem::relative(out)}), 2, "overwrite OUTPUT");
  expect_failure(run_tool({in, out, "--report", folder / "./in.vtk"}), 2, "overwrite INPUT");
  for (const char *report : {"pictures/report.html", "pictures/volume-dark.png"})
    expect_failure(run_tool({in, out, "--pictures", folder / "pictures", "--report", folder / report}), 2,
                   "overwrite one of the pictures");
  EXPECT_EQ(contents_of(in), whole);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"in.vtk", "link"}));
}

TEST_F(Usage, PipesAreNoFiles) {
  const std::string in = folder / "in.vtk", out = folder / "out.vtu", pipe = folder / "pipe.vtu";
  write_cube(in, {});
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_failure(run_tool_for_a_minute({pipe, out}), 1, "pipe.vtu: is not a file");
  expect_failure(run_tool({in, pipe}), 1, "pipe.vtu: is not a file");
  expect_failure(run_tool({in, out, "--report", pipe}), 1, "pipe.vtu: is not a file");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_FALSE(std::filesystem::exists(out));
}

void expect_too_large(const Outcome &outcome, const std::string &path) {
  expect_failure(outcome, 1, path + ": cannot be written: " + std::strerror(EFBIG));
}

TEST_F(Usage, AFileThatBecomesTooLarge) {
  write_cube(folder / "in.vtk", {});
  for (const std::string &out : {folder / "out.vtu", folder / "out.vtk"}) {
    const std::vector<std::string> words = {folder / "in.vtk", out, "--preset", "accurate", "--target-ratio", "0.9"};
    ASSERT_EQ(run_tool(words).status, 0);
    const long size = static_cast<long>(std::filesystem::file_size(out));
    std::filesystem::remove(out);
    for (const long limit : {300L, 1000L, 10000L, size / 2, size - 1})
      expect_too_large(run_tool_with_room(words, limit), out);
  }
  expect_only_input();
}

TEST_F(Usage, AStandardOutputThatIsFull) {
  write_cube(folder / "in.vtk", {});
  const std::string in = folder / "in.vtk", out = folder / "out.vtu";
  const std::string why = std::string("standard output cannot be written: ") + std::strerror(ENOSPC);
  expect_failure(run_tool_printing_to("/dev/full", {in, out}), 1, why);
  expect_failure(run_tool_printing_to("/dev/full", {"--help"}), 1, why);
  expect_failure(run_tool_printing_to("/dev/full", {"--version"}), 1, why);
  EXPECT_EQ(run_tool_printing_to("/dev/full", {in, out, "--quiet"}).status, 0) << "nothing to print";
}

TEST_F(Usage, AFieldThatIsNotThere) {
  expect_failure(run_on({}, {"--field", "cold"}), 1, "heat");
  expect_failure(run_on({}, {"--field", "cold"}), 1, "other");
  expect_failure(run_on({}, {"--steer", "cold:3"}), 1, "no field 'cold'");
  expect_failure(run_on({}, {"--steer", "not:so"}), 1, "no field 'not:so'");
  expect_failure(run_on({}, {"--steer", "x:1:1"}), 1, "no field 'x:1'");
  expect_failure(run_on({}, {"--steer", "heat"}), 1, "it is the first");
  expect_failure(run_on({}, {"--steer", ":2"}), 2, "--steer: ':2' is a weight without a name");
  expect_failure(run_on({}, {"--steer", "other", "--steer", "other:2"}), 2, "--steer: field 'other' is given twice");
  expect_only_input();
}

TEST_F(Usage, NamesThatXmlCannotHave) {
  const std::pair<const char *, const char *> names[] = {
      {"a%22b", "a\"b"},   {"a%22%20b=%22c", "a\" b=\"c"}, {"a<b", "a<b"},
      {"a&b", "a&b"},      {"a&amp;b", "a&amp;b"},         {"a%01z", "a\x01z"},
      {"a%E9z", "a\xE9z"},
  };
  for (const auto &[encoded, name] : names) {
    Cube cube;
    cube.other = encoded;
    std::string printed = name;
    std::replace(printed.begin(), printed.end(), '\x01', '?');
    expect_failure(run_on(cube), 1, "'" + printed + "'");
    expect_only_input();
    const Outcome legacy = run_tool({folder / "in.vtk", folder / "out.vtk", "--quiet"});
    EXPECT_EQ(legacy.status, 0) << legacy.err;
    std::filesystem::remove(folder / "out.vtk");
  }
}

// To the reader of .vtk files they have a name, which is empty.
TEST_F(Usage, ComponentsMayLackAName) {
  const std::string in = folder / "in.vtu", between = folder / "between.vtk", out = folder / "out.vtu";
  std::ofstream(in) << one_tet_in_xml(
      R"(<DataArray type="Float64" Name="pair" NumberOfComponents="2" ComponentName1="second" format="ascii">
0 0 0 1 1 0 1 1</DataArray>)");
  ASSERT_EQ(run_tool({in, between, "--target-ratio", "1"}).status, 0);
  const Outcome back = run_tool({between, out, "--target-ratio", "1"});
  EXPECT_EQ(back.status, 0) << back.err;
  EXPECT_NE(contents_of(out).find("second"), std::string::npos);
}

TEST_F(Usage, NamesOfComponentsThatXmlCannotHave) {
  write_cube(folder / "in.vtk", {});
  std::ofstream(folder / "in.vtk", std::ios::app) << "METADATA\nCOMPONENT_NAMES\nu\n%22v%22\nw\n\n";
  expect_failure(run_tool({folder / "in.vtk", folder / "out.vtu"}), 1, "'\"v\"'");
  expect_only_input();
}

TEST_F(Usage, BadMeshes) {
  for (const Kind kind : {Kind::tet, Kind::hexahedron, Kind::polyhedron}) {
    Cube cube;
    cube.kind = kind;
    cube.with_bad_index = true;
    expect_failure(run_on(cube), 1, "343");
    expect_only_input();
  }
}

TEST_F(Usage, AValueThatIsNone) {
  std::ofstream(folder / "in.vtu")
      << R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="2">
<PointData Scalars="heat"><DataArray type="Float64" Name="heat" format="binary">)"
      << "KAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAQAAAAAAAAAhAAAAAAAAA+H8="
      << R"(</DataArray><DataArray type="Float64" Name="x" format="ascii">0 1 2 3 4</DataArray></PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1 0 0 -1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 0 2 1 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  expect_failure(run_tool({folder / "in.vtu", folder / "out.vtu"}), 1,
                 "the value of field heat of vertex 4 is nan (on-nonfinite: error)");
  expect_failure(run_tool({folder / "in.vtu", folder / "out.vtu", "--field", "x", "--steer", "heat"}), 1,
                 "the value of field heat of vertex 4 is nan (on-nonfinite: error)");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.vtu"});
  const Outcome repaired = run_tool({folder / "in.vtu", folder / "out.vtu", "--quiet", "--on-nonfinite", "repair",
                                     "--pictures", folder / "pictures"});
  EXPECT_EQ(repaired.status, 0) << repaired.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/report.html"));
}

TEST_F(Usage, AnInterruptionLeavesNothingBehind) {
  Cube cube;
  cube.size = 30;
  write_cube(folder / "in.vtk", cube);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::vector<std::string> pictures = {"--pictures", folder / "p"};
    std::vector<std::string> arguments = {folder / "in.vtk", folder / "out.vtu"};
    if (signal == SIGHUP) arguments.insert(arguments.end(), pictures.begin(), pictures.end());
    expect_failure(interrupt_tool(arguments, signal), 128 + signal, "interrupted");
    expect_only_input();
  }
}

TEST_F(Usage, ValuesThatAreMissing) {
  const std::string in = folder / "in.vtk", out = folder / "out.vtu";
  write_cube(in, {});
  for (const std::string option : {"--report", "--pictures", "--field", "--steer", "--preset", "--rho"}) {
    expect_failure(run_tool({in, out, option + "=", "--quiet"}), 2, option);
    expect_failure(run_tool({option + "=", in, out}), 2, option);
    expect_failure(run_tool({in, out, option, "--max-error=0.1"}), 2, option);
  }
  expect_failure(run_tool({in, out, "--report", "-"}), 2, "names no file");
  expect_only_input();
}

TEST_F(Usage, StandardOutputIsNoFile) {
  write_cube(folder / "in.vtk", {});
  expect_failure(run_tool({folder / "in.vtk", folder / "out.vtu", "--report", "/dev/stdout"}), 1, "is not a file");
  expect_only_input();
}

}  // namespace
}  // namespace cli_test
