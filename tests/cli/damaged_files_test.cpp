// Files that are damaged, or not what they say.
#include <algorithm>
#include <fstream>
#include <utility>

#include "usage.hpp"

namespace cli_test {
namespace {

class DamagedFiles : public Usage {};

TEST_F(DamagedFiles, FilesThatCannotBeRead) {
  const std::string out = folder / "out.vtu";
  expect_failure(run_tool({folder / "missing.vtu", out}), 1, "missing.vtu");
  expect_failure(run_tool({folder / "missing.vtk", out}), 1, "missing.vtk");
  write_cube(folder / "in.vtk", {});
  const std::string whole = contents_of(folder / "in.vtk");
  for (const char *name : {"bad.vtu", "bad.vtk", "bad.pvtu"}) {
    std::ofstream(folder / name) << "this is no mesh\n";
    expect_failure(run_tool({folder / name, out}), 1, name);
    std::ofstream(folder / name, std::ios::trunc);
    expect_failure(run_tool({folder / name, out}), 1, name);
  }
  std::ofstream(folder / "cut.vtk") << whole.substr(0, whole.size() / 3);
  expect_failure(run_tool({folder / "cut.vtk", out}), 1, "cut.vtk");
  EXPECT_FALSE(std::filesystem::exists(out));
}

std::string with_count(std::string text, const std::string &name, const std::string &count) {
  const std::size_t begin = text.find(name + "=\"") + name.size() + 2;
  return text.replace(begin, text.find('"', begin) - begin, count);
}

// In the file itself, and in one that another names as its part.
TEST_F(DamagedFiles, CountsThatAreNone) {
  const std::string in = folder / "in.vtu", out = folder / "out.vtu", parts = folder / "parts.pvtu";
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", in}).status, 0);
  const std::string whole = contents_of(in);
  std::ofstream(parts) << R"(<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid>
<PPointData><PDataArray type="Float64" Name="heat"/></PPointData>
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>
<Piece Source="in.vtu"/></PUnstructuredGrid></VTKFile>)";
  for (const char *name : {"NumberOfPoints", "NumberOfCells"}) {
    for (const char *count : {"-1", "-2", "9223372036854775807", "many"}) {
      std::ofstream(in) << with_count(whole, name, count);
      expect_failure(run_tool({in, out}), 1, std::string(name) + "=\"" + count);
      expect_failure(run_tool({parts, out}), 1, std::string(name) + "=\"" + count);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

// Wherever a file of the old format ends, in numbers or in bytes, it is too short.
TEST_F(DamagedFiles, FilesThatEndTooSoon) {
  const std::string in = folder / "in.vtk", whole_file = folder / "whole.vtk", out = folder / "out.vtu";
  write_cube(in, {});
  ASSERT_EQ(run_tool({in, whole_file, "--sigma", "1"}).status, 0);
  for (const std::string &from : {in, whole_file}) {
    const std::string whole = contents_of(from);
    const std::size_t values = whole.rfind("LOOKUP_TABLE");
    for (std::size_t end : {values, whole.find('\n', values) + 1, (values + whole.size()) / 2}) {
      std::ofstream(folder / "part.vtk", std::ios::binary) << whole.substr(0, end);
      expect_failure(run_tool({folder / "part.vtk", out}), 1, "part.vtk: ");
    }
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

// A summary that is not that of its piece; VTK would copy into room for something else, or never end.
TEST_F(DamagedFiles, ArraysThatAreNotAsDeclared) {
  const std::string in = folder / "in.vtu", out = folder / "out.vtu", parts = folder / "parts.pvtu";
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", in}).status, 0);
  const auto expect_refused = [&](const std::string &of_points, const std::string &of_heat) {
    std::ofstream(parts) << R"(<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid>
<PPointData><PDataArray Name="heat" )" +
                                of_heat + R"(/></PPointData><PPoints><PDataArray )" + of_points +
                                R"(/></PPoints><Piece Source="in.vtu"/></PUnstructuredGrid></VTKFile>)";
    expect_failure(run_tool_for_a_minute({parts, out}), 1, "parts.pvtu: ");
  };
  const std::string points = R"(type="Float64" NumberOfComponents="3")", heat = R"(type="Float64")";
  expect_refused(R"(type="Float32" NumberOfComponents="3")", heat);
  expect_refused(R"(type="Float64" NumberOfComponents="4294967296")", heat);
  expect_refused(points, R"(type="Int8")");
  expect_refused(points, R"(type="Float64" NumberOfComponents="2")");
  expect_refused(points, R"(type="String")");
  expect_refused(points, R"(type="Bit")");
  std::string text = contents_of(in);
  const std::size_t named = text.rfind("<DataArray", text.find("Name=\"heat\""));
  text.replace(text.find("Float64", named), 7, "String");
  std::ofstream(in, std::ios::binary) << text;
  expect_failure(run_tool({in, out}), 1, "String");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(DamagedFiles, PartsOfTheInput) {
  const std::string parts = folder / "in.pvtu", part = folder / "in_0.vtu", out = folder / "out.vtu";
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", parts, "--sigma", "1"}).status, 0);
  const std::string before = contents_of(part);
  expect_failure(run_tool({parts, part}), 2, "OUTPUT would overwrite a part of INPUT");
  expect_failure(run_tool({parts, out, "--report", part}), 2, "--report would overwrite a part of INPUT");
  EXPECT_EQ(contents_of(part), before);
  std::filesystem::remove(part);
  expect_failure(run_tool({parts, out}), 1, "in_0.vtu cannot be read: No such file");
  EXPECT_FALSE(std::filesystem::exists(out));
}

// However it is spelled, and before INPUT is looked at.
// Opening a pipe would wait for the other side, and a result would take the pipe's place.
// As a full disk does, wherever it cuts the file. Edges are collapsed here, so that no other process needs files.
// What was asked for is to be printed, or else it failed.
// VTK writes names into the file as they are, which no one could read.
// VTK reads none from text: 0, 1, 2, 3 and nan are in base 64, after their size.
// Of one cell: how many, and of each how many points, and these; and where the next cell's begin.
TEST_F(DamagedFiles, FacesThatAreBroken) {
  const auto run_with = [&](const std::string &faces, const std::string &end) {
    std::ofstream(folder / "in.vtu") << R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData Scalars="heat"><DataArray type="Float64" Name="heat" format="ascii">0 1 2 3</DataArray></PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">42</DataArray>
<DataArray type="Int64" Name="faces" format="ascii">)"
                                     << faces
                                     << R"(</DataArray><DataArray type="Int64" Name="faceoffsets" format="ascii">)"
                                     << end << "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
    return run_tool({folder / "in.vtu", folder / "out.vtu", "--target-ratio", "1"});
  };
  const std::string last = " 3 0 1 3 3 1 2 3 3 2 0 3";
  for (const std::string &faces : {"5 3 0 1 2" + last, "3 3 0 1 2" + last, "99999999 3 0 1 2" + last,
                                   "4 99999999 0 1 2" + last, "4 -3 0 1 2" + last, "-4 3 0 1 2" + last})
    expect_failure(run_with(faces, "17"), 1, "the faces of polyhedra are broken");
  for (const char *end : {"16", "18", "99999999", "0"}) expect_failure(run_with("4 3 0 1 2" + last, end), 1, "in.vtu");
  expect_failure(run_with("4 3 0 1 7" + last, "17"), 1, "cell 0 names point 7, which the mesh does not have");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"in.vtu"});
  const Outcome sound = run_with("4 3 0 1 2" + last, "17");
  EXPECT_EQ(sound.status, 0) << sound.err;
}

TEST_F(DamagedFiles, AValueThatIsNoneInText) {
  std::ofstream(folder / "in.vtk") << "# vtk DataFile Version 3.0\nno title\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                      "POINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 0 0 -1\n"
                                      "CELLS 2 10\n4 0 1 2 3\n4 0 2 1 4\nCELL_TYPES 2\n10\n10\n"
                                      "POINT_DATA 5\nSCALARS heat double 1\nLOOKUP_TABLE default\n0 1 nan 3 4\n";
  expect_failure(run_tool({folder / "in.vtk", folder / "out.vtu"}), 1, "does not read from text, as nan");
}

// A script ends with it then: the process dies of the signal.
// Of a variable of a script that was not set; the option after it is none.
// The types of cells, which VTK writes last, are none then.
TEST_F(DamagedFiles, AFileWithoutItsEnd) {
  std::ofstream(folder / "cut.vtu") << one_tet_in_xml("", "0");
  expect_failure(run_tool({folder / "cut.vtu", folder / "out.vtu"}), 1, "cut.vtu: is damaged: cell 0 has points");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.vtu"));
}

// It divides by the size of compressed blocks, whatever the file says.
TEST_F(DamagedFiles, AFileThatItsReaderDiesOf) {
  const std::string in = folder / "in.vtu";
  write_cube(folder / "in.vtk", {});
  ASSERT_EQ(run_tool({folder / "in.vtk", in, "--sigma", "1"}).status, 0);
  std::string bytes = contents_of(in);
  ASSERT_NE(bytes.find("compressor="), std::string::npos);
  const std::size_t width = bytes.find("header_type=\"UInt64\"") != std::string::npos ? 8 : 4;
  const std::size_t count_of_blocks = bytes.find('_', bytes.find("<AppendedData")) + 1;
  std::fill_n(bytes.begin() + std::ptrdiff_t(count_of_blocks + width), width, '\0');
  std::ofstream(folder / "damaged.vtu", std::ios::binary) << bytes;
  expect_failure(run_tool({folder / "damaged.vtu", folder / "out.vtu"}), 1, "damaged.vtu: is damaged");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.vtu"));
}

// The file that it leads to would be gone.

}  // namespace
}  // namespace cli_test
