// Every format and kind of cell that the tool reads and writes. The field is linear, so the result's error is rounding
// only, and a split that did not fit would leave more boundary triangles than the cube's sides have.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "mesh_file.hpp"
#include "tool.hpp"

namespace cli_test {
namespace {

using Json = nlohmann::json;

class Files : public testing::Test {
 protected:
  // The report of a run that is expected to succeed. All boundary edges are kept: these tests are about files.
  Json run(const std::string &in, const std::string &out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {in, out, "--sigma", "1", "--report", folder / "report.json"});
    said = run_tool(more);
    EXPECT_EQ(said.status, 0) << said.err;
    std::ifstream file(folder / "report.json");
    return Json::parse(file, nullptr, false);
  }
  Json run_on(const Cube &cube) {
    write_cube(folder / "in.vtk", cube);
    return run(folder / "in.vtk", folder / "out.vtu");
  }

  Folder folder;
  Outcome said;
};

void expect_linear_field_kept(const Json &report) {
  ASSERT_TRUE(report.is_object());
  EXPECT_GT(report["tets_out"], 0);
  EXPECT_LT(report["error"]["max"], 1e-5);
  EXPECT_EQ(report["error"]["outside"], 0.0);
}

struct Split {
  Kind kind;
  int least_tets, most_tets, triangles;  // a cell, and a square of the cube's sides
};

class Splits : public Files, public testing::WithParamInterface<Split> {};

TEST_P(Splits, NeighboursFit) {
  Cube cube;
  cube.kind = GetParam().kind;
  const int cells = cube.size * cube.size * cube.size, squares = 6 * cube.size * cube.size;
  const Json report = run_on(cube);
  expect_linear_field_kept(report);
  EXPECT_GE(report["tets_in"], GetParam().least_tets * cells);
  EXPECT_LE(report["tets_in"], GetParam().most_tets * cells);
  EXPECT_EQ(report["boundary_triangles_in"], GetParam().triangles * squares);
  EXPECT_EQ(report["components"], 1);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Splits,
                         testing::Values(Split{Kind::tet, 6, 6, 2}, Split{Kind::hexahedron, 5, 6, 2},
                                         Split{Kind::voxel, 5, 6, 2}, Split{Kind::wedge, 6, 6, 2},
                                         Split{Kind::pyramid, 12, 12, 2}, Split{Kind::quadratic_tet, 48, 48, 8},
                                         Split{Kind::quadratic_hexahedron, 5, 6, 2},
                                         Split{Kind::polyhedron, 12, 12, 2}));

TEST_F(Files, FloatsAndIntegersOfEitherWidth) {
  for (const char *real : {"float", "double"}) {
    for (const char *integer : {"", "int", "vtktypeint64"}) {
      Cube cube;
      cube.real = real;
      cube.integer = integer;
      expect_linear_field_kept(run_on(cube));
    }
  }
}

TEST_F(Files, SurfaceCellsAreLeftOutAndSaidSo) {
  Cube cube;
  cube.with_triangle = true;
  expect_linear_field_kept(run_on(cube));
  EXPECT_EQ(lines_of(said.err), 1) << said.err;
  EXPECT_NE(said.err.find("left out"), std::string::npos) << said.err;
}

// The result is read again, as .vtu and as .vtk, and holds what the report counted.
TEST_F(Files, ResultsAreFilesOfTheSameKind) {
  write_cube(folder / "in.vtk", {});
  for (const char *name : {"out.vtu", "out.vtk"}) {
    const Json first = run(folder / "in.vtk", folder / name, {"--field", "other"});
    const Json second = run(folder / name, folder / "again.vtu", {"--field", "other"});
    EXPECT_EQ(second["tets_in"], first["tets_out"]);
    EXPECT_EQ(second["points_in"], first["points_out"]);
    expect_linear_field_kept(second);
  }
}

// The line of an XML file that describes an array.
std::string array_tag(const std::string &text, const std::string &name) {
  const std::size_t at = text.find("Name=\"" + name + "\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = text.rfind('<', at);
  return text.substr(begin, text.find('>', at) - begin);
}

void expect_in(const std::string &text, const std::string &part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

// Whatever the cells are, each tet takes its cell's value; types stay.
TEST_F(Files, AllOtherArraysRideAlong) {
  for (Kind kind : {Kind::tet, Kind::hexahedron, Kind::quadratic_tet, Kind::wedge}) {
    Cube cube;
    cube.kind = kind;
    cube.real = "float";
    expect_linear_field_kept(run_on(cube));
    const std::string out = contents_of(folder / "out.vtu");
    for (const char *part : {"type=\"Float32\"", "RangeMin=\"0\"", "RangeMax=\"1\""})
      expect_in(array_tag(out, "other"), part);
    for (const char *part : {"type=\"Float32\"", "NumberOfComponents=\"3\""}) expect_in(array_tag(out, "flow"), part);
    for (const char *part : {"type=\"Int32\"", "RangeMin=\"5\"", "RangeMax=\"6\""})
      expect_in(array_tag(out, "part"), part);
    EXPECT_LT(out.find("Name=\"flow\""), out.find("<CellData"));
    EXPECT_GT(out.find("Name=\"part\""), out.find("<CellData"));
  }
}

TEST_F(Files, NamesOutlastBothFormats) {
  const std::pair<const char *, const char *> names[] = {
      {"a%20'b'%20>%20c", "a 'b' > c"}, {"%C3%A9:1", "\xC3\xA9:1"}, {"%2525", "%25"}};
  for (const auto &[encoded, name] : names) {
    Cube cube;
    cube.other = encoded;
    run_on(cube);
    expect_linear_field_kept(run(folder / "out.vtu", folder / "again.vtk", {"--field", name}));
    EXPECT_EQ(run(folder / "again.vtk", folder / "out.vtu", {"--field", name})["field"], name);
  }
}

// Carried by the first run and steering the second, x is still x.
TEST_F(Files, ACarriedArrayIsAFieldLikeAnyOther) {
  write_cube(folder / "in.vtk", {});
  for (const char *name : {"out.vtu", "out.vtk"}) {
    run(folder / "in.vtk", folder / name);
    const Json report = run(folder / name, folder / "again.vtu", {"--field", "other"});
    expect_linear_field_kept(report);
  }
}

TEST_F(Files, TheFirstScalarsAreTheDefault) {
  EXPECT_EQ(run_on({})["field"], "heat");
  EXPECT_EQ(run(folder / "in.vtk", folder / "out.vtu", {"--field", "other"})["field"], "other");
}

// The vectors ride along.
TEST_F(Files, VectorsSteerByTheirMagnitude) {
  Cube cube;
  run_on(cube);
  expect_linear_field_kept(run(folder / "in.vtk", folder / "out.vtu", {"--field", "flow"}));
  cube.vectors_alone = true;
  const Json report = run_on(cube);
  expect_linear_field_kept(report);
  EXPECT_EQ(report["field"], "flow magnitude");
  EXPECT_EQ(report["scalar_max"], 1);
  expect_in(said.err, "note: the vectors 'flow' steer by their magnitude");
  const std::string out = contents_of(folder / "out.vtu");
  expect_in(array_tag(out, "flow"), "NumberOfComponents=\"3\"");
  expect_in(array_tag(out, "flow magnitude"), "RangeMax=\"1\"");
  expect_in(run_tool({folder / "in.vtk", folder / "out.vtu", "--steer", "flow"}).err, "it is the first");
  run(folder / "out.vtu", folder / "again.vtu", {"--field", "flow"});
  expect_in(said.err, "note: the vectors 'flow' steer by the file's array 'flow magnitude'");
  cube.vectors_alone = false;
  run_on(cube);
  run(folder / "in.vtk", folder / "out.vtu", {"--steer", "flow:2"});
  expect_in(said.err, "note: the vectors 'flow' steer by their magnitude");
  const Outcome twice =
      run_tool({folder / "out.vtu", folder / "again.vtu", "--steer", "flow", "--steer", "flow magnitude"});
  expect_in(twice.err, "'flow magnitude' is given twice");
  EXPECT_EQ(twice.status, 2);
}

// A sum of parts, as 7 / 6, may be off by rounding.
TEST_F(Files, MeansOfAConstantAreThat) {
  Cube cube;
  cube.cells_alone = cube.one_part = true;
  for (const Kind kind : {Kind::tet, Kind::polyhedron}) {
    cube.kind = kind;
    const Json report = run_on(cube);
    EXPECT_EQ(report["scalar_min"], 7);
    EXPECT_EQ(report["scalar_max"], 7);
    expect_in(said.err, "the field 'part' is constant");
  }
}

// Layers of cells across x have 5 and 6 in turns: the first and the last points have one kind around them, all others
// both.
TEST_F(Files, CellDataSteerByTheirMeansAroundPoints) {
  Cube cube;
  cube.kind = Kind::hexahedron;
  run_on(cube);
  const char *const note = "note: the cell data 'part' steers by the means of the cells around each point";
  const std::vector<std::string> options = {"--target-ratio", "1"};
  for (const bool cells_alone : {false, true}) {
    cube.cells_alone = cells_alone;
    write_cube(folder / "in.vtk", cube);
    std::vector<std::string> more = options;
    if (!cells_alone) more.insert(more.end(), {"--field", "part"});
    const Json report = run(folder / "in.vtk", folder / "out.vtu", more);
    expect_in(said.err, note);
    EXPECT_EQ(report["field"], "part");
    EXPECT_EQ(report["scalar_min"], 5);
    EXPECT_EQ(report["scalar_max"], 6);
  }
  run(folder / "out.vtu", folder / "again.vtu", {"--field", "part"});
  EXPECT_EQ(said.err.find(note), std::string::npos) << "points have it now";
  cube.with_bad_index = true;
  write_cube(folder / "in.vtk", cube);
  expect_in(run_tool({folder / "in.vtk", folder / "out.vtu"}).err, "names point 343, which the mesh does not have");
}

// Two cubes side by side: the points of the side between them are in both pieces, and become one.
TEST_F(Files, PartitionedFilesAreOneMesh) {
  Cube cube;
  const int row = cube.size + 1;
  for (const char *name : {"left.vtu", "right.vtu"}) {
    write_cube(folder / "in.vtk", cube);
    run(folder / "in.vtk", folder / name);
    cube.shift = 1;
  }
  std::ofstream(folder / "whole.pvtu") << R"(<VTKFile type="PUnstructuredGrid" version="0.1">
<PUnstructuredGrid GhostLevel="0">
<PPointData Scalars="heat"><PDataArray type="Float64" Name="heat"/></PPointData>
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>
<Piece Source="left.vtu"/><Piece Source="right.vtu"/>
</PUnstructuredGrid></VTKFile>)";
  const Json report = run(folder / "whole.pvtu", folder / "out.vtu");
  expect_linear_field_kept(report);
  EXPECT_EQ(report["merged_points"], row * row);
  EXPECT_EQ(report["components"], 1);
}

// As VTK's own writer makes it of 64 bit integers: its reader takes global numbers for another kind of integers.
TEST_F(Files, PartitionedFilesMayHaveGlobalNumbers) {
  std::ofstream(folder / "piece.vtu") << R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData Scalars="heat" GlobalIds="number"><DataArray type="Float64" Name="heat" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="number" format="ascii">7 8 9 10</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  std::ofstream(folder / "whole.pvtu") << R"(<VTKFile type="PUnstructuredGrid" version="0.1">
<PUnstructuredGrid GhostLevel="0">
<PPointData Scalars="heat" GlobalIds="number"><PDataArray type="Float64" Name="heat"/>
<PDataArray type="Int64" Name="number"/></PPointData>
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>
<Piece Source="piece.vtu"/>
</PUnstructuredGrid></VTKFile>)";
  EXPECT_EQ(run(folder / "whole.pvtu", folder / "out.vtu", {"--field", "heat"})["tets_in"], 1);
}

// A summary and its one piece: nothing else is left, and both together are what a single file is.
TEST_F(Files, ResultsMayBePartitionedFiles) {
  namespace fs = std::filesystem;
  const Json report = run_on({});
  write_cube(folder / "in.vtk", {});
  fs::remove(folder / "out.vtu");
  run(folder / "in.vtk", folder / "small.pvtu");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"in.vtk", "report.json", "small.pvtu", "small_0.vtu"}));
  const Json again = run(folder / "small.pvtu", folder / "out.vtu");
  expect_linear_field_kept(again);
  EXPECT_EQ(again["tets_in"], report["tets_out"]);
  EXPECT_EQ(again["merged_points"], 0);
}

// VTK cuts names at their first dot, and writes them between quotes as they are.
TEST_F(Files, APieceIsFoundWhateverItsName) {
  write_cube(folder / "in.vtk", {});
  for (const char *name : {"run.0.5", "a&b", "x<y", "q\"x", "it's", "x y", "x%20y"}) {
    const std::string summary = folder / (std::string(name) + ".pvtu");
    const Json report = run(folder / "in.vtk", summary);
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string(name) + "_0.vtu"))) << name;
    EXPECT_EQ(run(summary, folder / "out.vtu")["tets_in"], report["tets_out"]) << name;
  }
}

TEST_F(Files, NothingElseTakesThePlaceOfThePiece) {
  const std::string piece = folder / "small_0.vtu";
  write_cube(folder / "in.vtk", {});
  run(folder / "in.vtk", folder / "small.pvtu");
  const std::string before = contents_of(piece);
  for (const std::vector<std::string> &command :
       {std::vector<std::string>{folder / "in.vtk", folder / "small.pvtu", "--report", piece},
        {folder / "in.vtk", folder / "small.pvtu", "--pictures", piece},
        {piece, folder / "small.pvtu"}}) {
    const Outcome refused = run_tool(command);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_NE(refused.err.find("small_0.vtu"), std::string::npos) << refused.err;
    EXPECT_EQ(contents_of(piece), before);
  }
}

TEST_F(Files, WhereAPieceCannotBeNothingIsWritten) {
  write_cube(folder / "in.vtk", {});
  std::filesystem::create_directory(folder / "small_0.vtu");
  const Outcome refused = run_tool({folder / "in.vtk", folder / "small.pvtu"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "tetlod: " + (folder / "small_0.vtu") + ": is not a file\n");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"in.vtk", "small_0.vtu"}));
}

// A link into another folder, with or without a file at its end, stays a link.
TEST_F(Files, AResultIsWrittenWhereALinkLeads) {
  namespace fs = std::filesystem;
  fs::create_directory(folder / "far");
  fs::create_symlink("far/out.vtu", folder / "near.vtu");
  fs::create_symlink("near.vtu", folder / "out.vtu");
  for (const char *before : {"", "an older result"}) {
    if (*before != 0) std::ofstream(folder / "far/out.vtu") << before;
    expect_linear_field_kept(run_on({}));
    EXPECT_TRUE(fs::is_symlink(folder / "out.vtu") && fs::is_symlink(folder / "near.vtu"));
    expect_in(contents_of(folder / "far/out.vtu"), "<VTKFile");
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"far", "in.vtk", "near.vtu", "out.vtu", "report.json"}));
}

TEST_F(Files, AResultKeepsItsPermissionsAndMayHaveALongName) {
  namespace fs = std::filesystem;
  write_cube(folder / "in.vtk", {});
  const std::string out = folder / (std::string(250, 'n') + ".vtu");
  std::ofstream(out) << "old";
  fs::permissions(out, fs::perms::owner_read | fs::perms::owner_write);
  run(folder / "in.vtk", out);
  EXPECT_EQ(fs::status(out).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_GT(fs::file_size(out), 100U);
}

TEST_F(Files, NothingIsLeftBesideTheResult) {
  run_on({});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"in.vtk", "out.vtu", "report.json"}));
}

// One tet in a legacy file, with data of the grid and of its cell.
std::string one_tet(const std::string &of_grid, const std::string &of_cell) {
  return "# vtk DataFile Version 4.2\none\nASCII\nDATASET UNSTRUCTURED_GRID\n" + of_grid +
         "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
         "POINT_DATA 4\nSCALARS heat double 1\nLOOKUP_TABLE default\n0 1 2 3\n"
         "CELL_DATA 1\nFIELD f 1\n" +
         of_cell;
}

// What VTK's writers would lose without a word, or its readers take wrongly.
TEST_F(Files, WhatAFormatLosesIsRefused) {
  const std::string in = folder / "in.vtk", part = "part 1 1 int\n5\n";
  const struct {
    std::string text, out, message;
  } cases[] = {
      {one_tet("", "flags 2 1 bit\n1 0\n"), "out.vtk", "'flags' of cells, several bits each"},
      {one_tet("", "flag 1 1 bit\n1\n"), "out.pvtu", "'flag' of bits"},
      {one_tet("", "few 1 0 int\n"), "out.vtu", "array 'few': 0 tuples for 1 cells"},
      {one_tet("FIELD FieldData 1\nT%3C0 1 1 double\n7\n", part), "out.vtu", "cannot have the name 'T<0'"},
  };
  for (const auto &one : cases) {
    std::ofstream(in) << one.text;
    const Outcome refused = run_tool({in, folder / one.out, "--target-ratio", "1"});
    EXPECT_EQ(refused.status, 1) << one.message;
    expect_in(refused.err, one.message);
    EXPECT_FALSE(std::filesystem::exists(folder / one.out));
  }
}

TEST_F(Files, NamesThatAreMissingOrLost) {
  const std::string in = folder / "in.vtk", between = folder / "between.vtu", out = folder / "out.vtk";
  std::ofstream(in) << one_tet("", "my%20part 1 1 unsigned_char\n9\n");
  ASSERT_EQ(run_tool({in, between, "--target-ratio", "1"}).status, 0);
  std::string text = contents_of(between);
  const std::string data = "<CellData", name = "Name=\"my part\"";
  std::ofstream(between, std::ios::binary) << text.insert(text.find(data) + data.size(), " Scalars=\"my part\"");
  expect_in(run_tool({between, out}).err, "'my part' of cells, a blank in their name");
  const std::string longest = "Name=\"" + std::string(256, 'n') + "\"";
  std::ofstream(between, std::ios::binary) << std::string(text).replace(text.rfind(name), name.size(), longest);
  expect_in(run_tool({between, out}).err, "cannot have so long a name");
  std::ofstream(between, std::ios::binary) << text.replace(text.rfind(name), name.size(), "");
  expect_in(run_tool({between, out}).err, "an array of CellData has no name");
}

}  // namespace
}  // namespace cli_test
