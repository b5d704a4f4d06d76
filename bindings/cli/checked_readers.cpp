#include "checked_readers.hpp"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace cli {
namespace {

// No memory holds more; sizes in bytes are still far from overflow.
constexpr vtkTypeInt64 kMost = vtkTypeInt64{1} << 48;

// A count that is not there is the reader's to miss.
bool will_do(vtkXMLDataElement &piece, const char *count) {
  const char *text = piece.GetAttribute(count);
  vtkTypeInt64 number = 0;
  return text == nullptr || (piece.GetScalarAttribute(count, number) == 1 && 0 <= number && number <= kMost);
}

// Of points or cells, whose arrays are known by their names.
bool holds_named_arrays(const std::string &element) {
  return element == "PointData" || element == "CellData" || element == "PPointData" || element == "PCellData";
}

bool has_name(vtkXMLDataElement &array) {
  const char *const name = array.GetAttribute("Name");
  return name != nullptr && *name != 0;
}

// What is wrong with an array's declaration, or those inside of the element; empty: nothing.
std::string wrong_array(vtkXMLDataElement &element) {
  constexpr vtkTypeInt64 most = 1 << 20;  // components
  const std::string name = element.GetName();
  const char *const components = element.GetAttribute("NumberOfComponents"), *const type = element.GetAttribute("type");
  vtkTypeInt64 number = 1;
  if (components != nullptr &&
      (element.GetScalarAttribute("NumberOfComponents", number) != 1 || number < 0 || number > most))
    return std::string("NumberOfComponents=\"") + components + "\" is no number of them";
  if (type != nullptr && std::strcmp(type, "Bit") == 0 && name == "PDataArray")
    return "arrays of bits cannot be put together of parts";  // VTK puts them together wrongly
  if (type != nullptr && std::strcmp(type, "String") == 0 && (name == "DataArray" || name == "PDataArray"))
    return name + " cannot be of type String";
  for (int i = 0; i < element.GetNumberOfNestedElements(); i++) {
    vtkXMLDataElement &nested = *element.GetNestedElement(i);
    if (holds_named_arrays(name) && !has_name(nested)) return "an array of " + name + " has no name";
    if (const std::string wrong = wrong_array(nested); !wrong.empty()) return wrong;
  }
  return {};
}

bool holds_integers(vtkAbstractArray *array) {
  const int type = array->GetDataType();
  return vtkDataArray::SafeDownCast(array) != nullptr && type != VTK_FLOAT && type != VTK_DOUBLE && type != VTK_BIT;
}

// Room for one kind of values is no room for another. Integers of one width have several names: VTK reads global
// numbers as its own kind, whatever the file says.
bool same_kind(vtkAbstractArray *a, vtkAbstractArray *b) {
  if (a == nullptr || b == nullptr || a->GetNumberOfComponents() != b->GetNumberOfComponents()) return false;
  return a->GetDataType() == b->GetDataType() ||
         (holds_integers(a) && holds_integers(b) && a->GetDataTypeSize() == b->GetDataTypeSize());
}

// Of each cell that has some: how many, and of each how many points, and these; up to the cell's end.
bool are_faces(vtkDataArray &faces, vtkDataArray &ends) {
  vtkIdType at = 0;
  const auto next = [&](vtkIdType end) { return at < end ? static_cast<vtkIdType>(faces.GetComponent(at++, 0)) : -1; };
  for (vtkIdType c = 0; c < ends.GetNumberOfTuples(); c++) {
    const auto end = static_cast<vtkIdType>(ends.GetComponent(c, 0));
    if (end < 0) continue;
    if (end <= at) return false;
    for (vtkIdType left = next(end); left > 0; left--) {
      const vtkIdType points = next(end);
      if (points < 0 || points > end - at) return false;
      at += points;
    }
    if (at != end) return false;
  }
  return true;
}

}  // namespace

vtkStandardNewMacro(CheckedReader);
vtkStandardNewMacro(CheckedPartsReader);

// Goes on with an empty piece: a reader of parts would go on anyway.
int CheckedReader::ReadPiece(vtkXMLDataElement *piece) {
  for (const char *count : {"NumberOfPoints", "NumberOfCells"}) {
    if (will_do(*piece, count)) continue;
    vtkErrorMacro(<< count << "=\"" << piece->GetAttribute(count) << "\" is no number of them");
    piece->SetAttribute("NumberOfPoints", "0");
    piece->SetAttribute("NumberOfCells", "0");
  }
  if (const std::string wrong = wrong_array(*piece); !wrong.empty()) {
    vtkErrorMacro(<< wrong);
    return 0;
  }
  return vtkXMLUnstructuredGridReader::ReadPiece(piece);
}

int CheckedReader::ReadPieceData() {
  if (!has_broken_faces()) return vtkXMLUnstructuredGridReader::ReadPieceData();
  vtkErrorMacro(<< "the faces of polyhedra are broken");
  return 0;
}

bool CheckedReader::has_broken_faces() {
  vtkXMLDataElement *const cells = this->CellElements[this->Piece];
  vtkXMLDataElement *const of_faces = this->FindDataArrayWithName(cells, "faces");
  vtkXMLDataElement *const of_ends = this->FindDataArrayWithName(cells, "faceoffsets");
  if (of_faces == nullptr || of_ends == nullptr) return false;
  const auto ends = values_of(of_ends, this->GetNumberOfCellsInPiece(this->Piece));
  if (ends == nullptr) return true;
  vtkIdType length = 0;
  for (vtkIdType c = 0; c < ends->GetNumberOfTuples(); c++)
    length = std::max(length, static_cast<vtkIdType>(ends->GetComponent(c, 0)));
  const auto faces = values_of(of_faces, length);
  return faces == nullptr || !are_faces(*faces, *ends);
}

// Null: there are not so many.
vtkSmartPointer<vtkDataArray> CheckedReader::values_of(vtkXMLDataElement *array, vtkIdType count) {
  const auto all = vtk::TakeSmartPointer(this->CreateArray(array));
  const vtkSmartPointer<vtkDataArray> values = vtkDataArray::SafeDownCast(all);
  if (values == nullptr || values->GetNumberOfComponents() != 1) return nullptr;
  values->SetNumberOfTuples(count);
  return count == 0 || this->ReadArrayValues(array, 0, values, 0, count) != 0 ? values : nullptr;
}

int CheckedPartsReader::ReadPrimaryElement(vtkXMLDataElement *primary) {
  find_parts(*primary);
  for (const std::string &part : parts_) {
    if (std::ifstream(part)) continue;
    vtkErrorMacro(<< "its part " << part << " cannot be read: " << std::strerror(errno));
    return 0;
  }
  if (const std::string wrong = wrong_array(*primary); !wrong.empty()) {
    vtkErrorMacro(<< wrong);
    return 0;
  }
  return vtkXMLPUnstructuredGridReader::ReadPrimaryElement(primary);
}

void CheckedPartsReader::find_parts(vtkXMLDataElement &primary) {
  parts_.clear();
  for (int i = 0; i < primary.GetNumberOfNestedElements(); i++) {
    vtkXMLDataElement &nested = *primary.GetNestedElement(i);
    const char *const source = nested.GetAttribute("Source");
    if (std::strcmp(nested.GetName(), "Piece") != 0 || source == nullptr) continue;
    const std::unique_ptr<char[]> part(this->CreatePieceFileName(source));
    parts_.emplace_back(part.get());
  }
}

// VTK adds the places of the faces of a piece's cells where it has polyhedra, and none where not.
int CheckedPartsReader::ReadPieceData() {
  vtkUnstructuredGrid &whole = *vtkUnstructuredGrid::SafeDownCast(this->GetCurrentOutput());
  const auto count = [&] { return whole.GetFaceLocations() ? whole.GetFaceLocations()->GetNumberOfValues() : 0; };
  const vtkIdType before = count();
  const int is_read = vtkXMLPUnstructuredGridReader::ReadPieceData();
  vtkIdTypeArray *const places = whole.GetFaceLocations();
  if (places == nullptr) return is_read;
  const std::vector<vtkIdType> own(places->GetPointer(before), places->GetPointer(before) + (count() - before));
  places->SetNumberOfValues(before);
  const auto pad = [&](vtkIdType cells) {
    while (count() < cells) places->InsertNextValue(-1);
  };
  pad(this->StartCell);
  for (const vtkIdType place : own) places->InsertNextValue(place);
  pad(this->StartCell + this->GetNumberOfCellsInPiece(this->Piece));
  return is_read;
}

void CheckedPartsReader::CopyArrayForPoints(vtkAbstractArray *from, vtkAbstractArray *to) {
  if (same_kind(from, to))
    vtkXMLPUnstructuredGridReader::CopyArrayForPoints(from, to);
  else
    vtkErrorMacro(<< "an array of the points is of another type in a piece");
}

void CheckedPartsReader::CopyArrayForCells(vtkAbstractArray *from, vtkAbstractArray *to) {
  if (same_kind(from, to))
    vtkXMLPUnstructuredGridReader::CopyArrayForCells(from, to);
  else
    vtkErrorMacro(<< "an array of the cells is of another type in a piece");
}

vtkXMLDataReader *CheckedPartsReader::CreatePieceReader() { return CheckedReader::New(); }

}  // namespace cli
