#include "checked_readers.hpp"

#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>

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
  return vtkXMLUnstructuredGridReader::ReadPiece(piece);
}

vtkXMLDataReader *CheckedPartsReader::CreatePieceReader() { return CheckedReader::New(); }

}  // namespace cli
