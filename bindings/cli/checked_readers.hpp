// VTK's readers of XML, where they take the counts of a piece on trust.
#pragma once

#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cli {

class CheckedReader : public vtkXMLUnstructuredGridReader {
 public:
  static CheckedReader *New();
  CheckedReader(const CheckedReader &) = delete;
  CheckedReader &operator=(const CheckedReader &) = delete;

 protected:
  CheckedReader() = default;
  ~CheckedReader() override = default;
  int ReadPiece(vtkXMLDataElement *piece) override;
};

class CheckedPartsReader : public vtkXMLPUnstructuredGridReader {
 public:
  static CheckedPartsReader *New();
  CheckedPartsReader(const CheckedPartsReader &) = delete;
  CheckedPartsReader &operator=(const CheckedPartsReader &) = delete;

 protected:
  CheckedPartsReader() = default;
  ~CheckedPartsReader() override = default;
  vtkXMLDataReader *CreatePieceReader() override;
};

}  // namespace cli
