#include "write_grid.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "failure.hpp"

namespace cli {
namespace {

// VTK takes every write that failed for a full disk; the system knows better.
std::string reason_of(int system_error, unsigned long code) {
  return system_error != 0 ? std::strerror(system_error) : vtkErrorCode::GetStringFromErrorCode(code);
}

// The writers call some failures a success, but leave their code.
template <class Writer>
void write_with(Writer &writer, const OutputFile &file, const std::string &at, vtkUnstructuredGrid *grid) {
  writer.SetFileName(at.c_str());
  writer.SetInputData(grid);
  errno = 0;
  const bool written = writer.Write() == 1;
  const int system_error = errno;
  const unsigned long code = writer.GetErrorCode();
  if (!written || code != vtkErrorCode::NoError) file.fail(reason_of(system_error, code));
}

template <class Writer>
void write_xml(const OutputFile &file, const std::string &at, vtkUnstructuredGrid *grid) {
  vtkNew<Writer> writer;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  write_with(*writer, file, at, grid);
}

void move(const OutputFile &file, const std::string &from) {
  std::error_code error;
  std::filesystem::rename(from, file.temporary(), error);
  if (error) file.fail(error.message());
}

std::string contents_of(const std::string &path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// As an attribute in XML.
std::string quoted(const std::string &text) {
  std::ostringstream quoted;
  vtkXMLUtilities::EncodeString(text.c_str(), VTK_ENCODING_UTF_8, quoted, VTK_ENCODING_UTF_8, 1);
  return '"' + quoted.str() + '"';
}

// In a folder of its own, under names that VTK neither cuts at a dot nor leaves unquoted; then the summary gets that of
// the piece.
void write_parts(const OutputFile &summary, const OutputFile &piece, vtkUnstructuredGrid *grid) {
  const PassingFolder folder(summary.temporary() + ".parts");
  const std::string at = folder / "whole.pvtu", source = "Source=\"whole_0.vtu\"";
  write_xml<vtkXMLPUnstructuredGridWriter>(summary, at, grid);
  move(piece, folder / "whole_0.vtu");
  std::string text = contents_of(at);
  const std::size_t place = text.find(source);
  if (place == std::string::npos) summary.fail("its piece has no name");
  const std::string name = std::filesystem::path(piece.path()).filename().string();
  summary.write(text.replace(place, source.size(), "Source=" + quoted(name)));
}

// Version 4.2 is what every reader of the format knows.
void write_legacy(const OutputFile &file, vtkUnstructuredGrid *grid) {
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileTypeToBinary();
  writer->SetFileVersion(vtkUnstructuredGridWriter::VTK_LEGACY_READER_VERSION_4_2);
  write_with(*writer, file, file.temporary(), grid);
}

// value: between quotes, as it stands in the file.
bool is_read_as(const std::string &name, const std::string &value) {
  const auto element =
      vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromString(("<Array Name=" + value + "/>").c_str()));
  const char *read = element != nullptr ? element->GetAttribute("Name") : nullptr;
  return read != nullptr && name == read;
}

// The writer puts names between quotes as they are.
bool survives_xml(const std::string &name) { return is_read_as(name, '"' + name + '"'); }

void check_name(const std::string &path, const char *name, const std::string &of_what) {
  if (name != nullptr && !survives_xml(name))
    throw Failure(path + ": a .vtu file cannot have the name '" + name + "' for " + of_what + "; .vtk can");
}

// VTK's reader of .vtk files gives components without a name an empty one, where others have names.
void check_names_of(const std::string &path, vtkAbstractArray *array) {
  check_name(path, array->GetName(), "an array");
  const char *const of = array->GetName();
  for (int i = 0; i < array->GetNumberOfComponents(); i++)
    if (const char *const name = array->GetComponentName(i); name != nullptr && *name != 0)
      check_name(path, name, "a component of '" + std::string(of != nullptr ? of : "") + "'");
}

// Readers put them together wrongly. Of points they become means.
void check_bits_of_parts(const std::string &path, vtkAbstractArray &array) {
  if (array.GetDataType() == VTK_BIT && array.GetName() != nullptr)
    throw Failure(path + ": a .pvtu file cannot have the array '" + array.GetName() + "' of bits; .vtu can");
}

// As the writer puts it into the file.
std::size_t length_in_legacy(const std::string &name) {
  const auto is_plain = [](unsigned char c) { return c > ' ' && c < 127 && c != '"' && c != '%'; };
  const auto plain = std::size_t(std::count_if(name.begin(), name.end(), is_plain));
  return plain + 3 * (name.size() - plain);
}

// The reader takes no more.
void check_length_for_legacy(const std::string &path, const char *name) {
  constexpr std::size_t most = 255;
  if (name != nullptr && length_in_legacy(name) > most)
    throw Failure(path + ": a .vtk file cannot have so long a name for an array: '" + name + "'; .vtu can");
}

// The writer loses all that follows several bits a cell, and what follows a blank in the name of colours.
void check_cells_of_legacy(const std::string &path, vtkCellData &data) {
  const auto refuse = [&](const char *name, const char *what) {
    throw Failure(path + ": a .vtk file cannot have the array '" + name + "' of cells, " + what + "; .vtu can");
  };
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkDataArray *const array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    const std::string name = array->GetName();
    if (array->GetDataType() == VTK_BIT && array->GetNumberOfComponents() > 1)
      refuse(name.c_str(), "several bits each");
    const bool are_colours = array == data.GetScalars() && array->GetDataType() == VTK_UNSIGNED_CHAR;
    if (are_colours && name.find_first_of(" \t") != std::string::npos) refuse(name.c_str(), "a blank in their name");
  }
}

}  // namespace

void check_arrays(const std::string &path, vtkUnstructuredGrid &grid) {
  const bool is_legacy = file_ending(path) == ".vtk", has_parts = file_ending(path) == ".pvtu";
  for (int type : {vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD}) {
    vtkFieldData &data = *grid.GetAttributesAsFieldData(type);
    for (int i = 0; i < data.GetNumberOfArrays(); i++) {
      vtkAbstractArray *const array = data.GetAbstractArray(i);
      if (is_legacy)
        check_length_for_legacy(path, array->GetName());
      else
        check_names_of(path, array);
      if (has_parts && type == vtkDataObject::CELL) check_bits_of_parts(path, *array);
    }
  }
  if (is_legacy) check_cells_of_legacy(path, *grid.GetCellData());
}

GridFile::GridFile(const std::string &path) : file_(path) {
  const std::string piece = piece_of(path);
  if (piece.empty()) return;
  const std::string name = std::filesystem::path(piece).filename().string();
  if (!is_read_as(name, quoted(name)))
    throw Failure(path + ": a .pvtu file cannot have the name of its piece, " + piece + ", in it");
  piece_.emplace(piece);
}

void GridFile::write(vtkUnstructuredGrid *grid, VtkMessages &messages, std::vector<std::string> &notes) const {
  if (piece_)
    write_parts(file_, *piece_, grid);
  else if (file_ending(file_.path()) == ".vtk")
    write_legacy(file_, grid);
  else
    write_xml<vtkXMLUnstructuredGridWriter>(file_, file_.temporary(), grid);
  messages.check(file_.path(), notes);
}

void GridFile::keep() {
  if (piece_) piece_->keep();
  file_.keep();
}

}  // namespace cli
