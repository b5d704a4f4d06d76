// The command line tool's reader: small .vtk and .vtu files with edits, and bytes that were never a file.
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "carried_arrays.hpp"
#include "demand.hpp"
#include "failure.hpp"
#include "host.hpp"
#include "original.hpp"
#include "quiet_vtk.hpp"
#include "read_grid.hpp"
#include "session.hpp"

namespace fuzz {

namespace {

// ---- Files that are in order ---------------------------------------------------------------------------------------

/// The unit cube's corners and the middles of some edges, for cells of every kind.
constexpr double places[][3] = {{0, 0, 0},     {1, 0, 0},     {1, 1, 0},   {0, 1, 0},     {0, 0, 1},   {1, 0, 1},
                                {1, 1, 1},     {0, 1, 1},     {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5},
                                {0.5, 0, 0.5}, {0, 0.5, 0.5}, {2, 0, 0},   {0.5, 0.5, 2}};

struct Cell {
  int type;
  std::vector<int> points;
};

using Cells = std::vector<Cell>;

const Cells &known_grid(std::size_t which) {
  static const Cells grids[] = {
      {{10, {0, 1, 3, 4}}, {10, {1, 2, 3, 6}}, {10, {1, 3, 4, 6}}, {10, {1, 4, 5, 6}}, {10, {3, 4, 6, 7}}},
      {{12, {0, 1, 2, 3, 4, 5, 6, 7}}, {14, {4, 5, 6, 7, 15}}, {5, {0, 1, 2}}},
      {{13, {0, 1, 3, 4, 5, 7}}, {11, {0, 1, 3, 2, 4, 5, 7, 6}}, {10, {1, 2, 5, 14}}, {3, {0, 1}}},
      {{24, {0, 1, 3, 4, 8, 9, 10, 11, 12, 13}}, {1, {15}}},
      {{24, {0, 1, 3, 4, 8, 9, 10, 11, 12, 13}}},
  };
  return grids[which % std::size(grids)];
}

void write_places(std::ostream &out) {
  for (const auto &p : places) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
}

void write_values(std::ostream &out) {
  for (std::size_t i = 0; i < std::size(places); i++) out << double(i) / 2 << ' ';
  out << '\n';
}

void write_vectors(std::ostream &out) {
  for (std::size_t i = 0; i < std::size(places); i++) out << i << ' ' << 2.5 << ' ' << -double(i) << '\n';
}

/// A number of a region for each.
void write_regions(std::ostream &out, const Cells &cells) {
  for (std::size_t c = 0; c < cells.size(); c++) out << 10 + c % 3 << ' ';
  out << '\n';
}

std::string legacy_file(const Cells &cells) {
  std::ostringstream out;
  out << "# vtk DataFile Version 3.0\nmade\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  out << "POINTS " << std::size(places) << " double\n";
  write_places(out);
  std::size_t size = 0;
  for (const Cell &cell : cells) size += 1 + cell.points.size();
  out << "CELLS " << cells.size() << ' ' << size << '\n';
  for (const Cell &cell : cells) {
    out << cell.points.size();
    for (const int v : cell.points) out << ' ' << v;
    out << '\n';
  }
  out << "CELL_TYPES " << cells.size() << '\n';
  for (const Cell &cell : cells) out << cell.type << '\n';
  out << "POINT_DATA " << std::size(places) << "\nSCALARS field double 1\nLOOKUP_TABLE default\n";
  write_values(out);
  out << "VECTORS velocity float\n";
  write_vectors(out);
  out << "CELL_DATA " << cells.size() << "\nSCALARS region int 1\nLOOKUP_TABLE default\n";
  write_regions(out, cells);
  return out.str();
}

std::string xml_file(const Cells &cells) {
  std::ostringstream out, corners, ends, types;
  std::size_t end = 0;
  for (const Cell &cell : cells) {
    for (const int v : cell.points) corners << v << ' ';
    ends << (end += cell.points.size()) << ' ';
    types << cell.type << ' ';
  }
  const auto array = [&](const char *type, const char *name, const std::string &text) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" format=\"ascii\">\n"
        << text << "\n</DataArray>\n";
  };
  std::ostringstream xyz, values, vectors, regions;
  write_places(xyz);
  write_values(values);
  write_vectors(vectors);
  write_regions(regions, cells);
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  out << "<Piece NumberOfPoints=\"" << std::size(places) << "\" NumberOfCells=\"" << cells.size()
      << "\">\n<PointData>\n";
  array("Float64", "field", values.str());
  array("Float32", "velocity\" NumberOfComponents=\"3", vectors.str());
  out << "</PointData>\n<CellData>\n";
  array("Int32", "region", regions.str());
  out << "</CellData>\n<Points>\n";
  array("Float32", "Points\" NumberOfComponents=\"3", xyz.str());
  out << "</Points>\n<Cells>\n";
  array("Int64", "connectivity", corners.str());
  array("Int64", "offsets", ends.str());
  array("UInt8", "types", types.str());
  out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return out.str();
}

// ---- Edits ---------------------------------------------------------------------------------------------------------

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Where the numbers begin in the lines that begin with one; not the first of several, which may say how many follow.
std::vector<std::size_t> numbers_of(const std::string &text) {
  std::vector<std::size_t> found;
  bool in_data = false;
  for (std::size_t i = 1; i < text.size(); i++) {
    const bool first = text[i - 1] == '\n';
    if (first) in_data = is_digit(text[i]);
    const bool alone = first && text.find_first_of(" \n", i) == text.find('\n', i);
    if (in_data && is_digit(text[i]) && (alone || text[i - 1] == ' ')) found.push_back(i);
  }
  return found;
}

std::size_t word_length(const std::string &text, std::size_t at) {
  return std::min(text.find_first_of(" \n\"<>", at), text.size()) - at;
}

/// A real number where the line has such, otherwise one that fits a cell's corners, kind, or end: VTK makes room for as
/// many corners as an end says.
void replace_number(std::string &text, Bytes &in) {
  static const char *const reals[] = {"nan", "inf", "1e300", "-1e-320", "2147483648", "-1.5"};
  static const char *const integers[] = {"0",  "1",  "2",  "3",  "4",  "5",  "6",  "8",  "9",   "10",   "11",
                                         "12", "13", "14", "15", "16", "24", "25", "71", "255", "4000", "65536"};
  const std::vector<std::size_t> numbers = numbers_of(text);
  if (numbers.empty()) return;
  const std::size_t at = numbers[in.below(numbers.size())];
  const bool real = text.find('.', text.rfind('\n', at)) < text.find('\n', at);
  const char *const word = real ? reals[in.below(std::size(reals))] : integers[in.below(std::size(integers))];
  text.replace(at, word_length(text, at), word);
}

std::size_t line_begin(const std::string &text, Bytes &in) {
  const std::size_t at = text.rfind('\n', in.below(text.size()));
  return at == std::string::npos ? 0 : std::min(at + 1, text.size());
}

std::size_t line_end(const std::string &text, std::size_t begin) {
  const std::size_t end = text.find('\n', begin);
  return end == std::string::npos ? text.size() : end + 1;
}

void drop_line(std::string &text, Bytes &in) {
  if (text.empty()) return;
  const std::size_t begin = line_begin(text, in);
  text.erase(begin, line_end(text, begin) - begin);
}

void repeat_line(std::string &text, Bytes &in) {
  if (text.empty()) return;
  const std::size_t begin = line_begin(text, in), target = line_begin(text, in);
  text.insert(target, text.substr(begin, line_end(text, begin) - begin));
}

void cut_off(std::string &text, Bytes &in) { text.resize(in.below(text.size() + 1)); }

void change_letter(std::string &text, Bytes &in) {
  if (!text.empty()) text[in.below(text.size())] = char(in.byte());
}

void replace_word(std::string &text, Bytes &in) {
  static const char *const words[] = {"double",  "float",    "int",       "ASCII",      "BINARY", "Float32",
                                      "Float64", "Int32",    "Int64",     "UInt8",      "String", "VECTORS",
                                      "FIELD",   "METADATA", "CELL_DATA", "POINT_DATA", "bit",    "vtkIdType",
                                      "ascii",   "binary",   "appended",  "points"};
  const std::string from = words[in.below(std::size(words))], to = words[in.below(std::size(words))];
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
}

/// VTK's own readers crash on headers that lie. Not our code: those edits are for who wants to see it.
bool wants_wild_headers() {
  static const bool wanted = std::getenv("TETLOD_FUZZ_HEADERS") != nullptr;
  return wanted;
}

using Edit = void (*)(std::string &, Bytes &);
constexpr Edit edits[] = {replace_number, replace_number, drop_line, repeat_line, cut_off, change_letter, replace_word};
constexpr std::size_t mild_edits = 2;  // the first ones

void edit(std::string &text, Bytes &in) {
  const std::size_t kinds = wants_wild_headers() ? std::size(edits) : mild_edits;
  for (std::size_t count = in.below(8); count > 0; count--) edits[in.below(kinds)](text, in);
}

/// A file, and what its name ends with.
struct File {
  std::string ending, text;
};

File decode_file(Bytes &in) {
  const std::size_t kind = in.below(8), which = in.byte();
  File file{kind % 2 ? ".vtu" : ".vtk", {}};
  if (kind < 2 && wants_wild_headers()) {
    while (!in.empty()) file.text += char(in.byte());
    return file;
  }
  file.text = kind % 2 ? xml_file(known_grid(which)) : legacy_file(known_grid(which));
  edit(file.text, in);
  return file;
}

// ---- The reader ----------------------------------------------------------------------------------------------------

class FileOnDisk {
 public:
  explicit FileOnDisk(const File &file)
      : path_(std::filesystem::temp_directory_path() / ("tetlod-fuzz-" + std::to_string(getpid()) + file.ending)) {
    std::ofstream(path_, std::ios::binary) << file.text;
  }
  ~FileOnDisk() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  FileOnDisk(const FileOnDisk &) = delete;
  FileOnDisk &operator=(const FileOnDisk &) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

constexpr double patience = 20;  // seconds for a run

/// Every array of the file is one of the result.
void run(tetlod::Context &context, const tetlod_vtk::OriginalArrays &arrays) {
  const tetlod_status status = tetlod_run(context.get());
  DEMAND(status != TETLOD_ERR_ARGUMENT && status != TETLOD_ERR_STATE, "a mesh of a file can be run: %d", status);
  check_documented("tetlod_run", status,
                   {TETLOD_ERR_TIME_LIMIT, TETLOD_ERR_REMESH, TETLOD_ERR_MESH_EMPTY, TETLOD_ERR_MESH_INDEX,
                    TETLOD_ERR_MESH_NONFINITE, TETLOD_ERR_MESH_DEGENERATE, TETLOD_ERR_MESH_NONMANIFOLD,
                    TETLOD_ERR_MESH_INTERSECTING});
  if (status != TETLOD_OK) return;
  const tetlod::Counts counts = context.fetch_counts();
  for (const tetlod_vtk::CarriedArray &other : arrays.others) {
    const auto made = tetlod_vtk::fetch_carried(context, other, counts.points);
    DEMAND(made->GetNumberOfTuples() == counts.points, "array %s is in the result", other.name());
  }
  const auto of_cells = tetlod_vtk::fetch_all(context, arrays.of_cells, counts.tets);
  for (std::size_t i = 0; i < of_cells.size(); i++)
    DEMAND(of_cells[i]->GetNumberOfTuples() == counts.tets &&
               of_cells[i]->GetDataType() == arrays.of_cells.all[i].original->GetDataType(),
           "array %zu of the cells is what it was", i);
}

/// As the tool and the filter do it: what goes wrong is a Failure or a std::runtime_error, or memory that is not there.
/// A mesh of a file can be checked: what is wrong with it is in the report.
void read(const std::string &path, bool runs) {
  const vtkSmartPointer<cli::VtkMessages> messages = vtkSmartPointer<cli::VtkMessages>::New();
  messages->install();
  std::vector<std::string> notes;
  const auto grid = cli::read_grid(path, *messages, notes).grid;
  const auto original = tetlod_vtk::original_of(grid, nullptr, {}, nullptr, notes);
  messages->check(path, notes);
  tetlod::Context context;
  context.set_real(TETLOD_OPT_TIME_LIMIT, patience);
  tetlod_vtk::submit(context, original);
  context.check();
  if (runs) run(context, original.arrays);
}

}  // namespace

}  // namespace fuzz

/// VTK's XML reader forgets the array of cell types when a file is broken; nobody else makes such an array. Visible, as
/// the sanitizer may be a shared library.
extern "C" __attribute__((visibility("default"))) const char *__lsan_default_suppressions() {
  return "leak:vtkUnsignedCharArray\n";
}
extern "C" __attribute__((visibility("default"))) const char *__lsan_default_options() {
  return "print_suppressions=0";
}

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  fuzz::settle();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Bytes in(data, size);
  const fuzz::File file = fuzz::decode_file(in);
  fuzz::trace("%s\n", file.text.c_str());
  const fuzz::FileOnDisk disk(file);
  try {
    fuzz::read(disk.path(), size % 4 == 0);
  } catch (const tetlod::Error &error) {
    DEMAND(false, "what a file holds is submitted and checked: %d, %s", error.status(), error.what());
  } catch (const std::runtime_error &failure) {
    fuzz::trace("%s\n", failure.what());
    DEMAND(*failure.what(), "a failure has a message");
  } catch (const std::bad_alloc &) {
  }
  return 0;
}
