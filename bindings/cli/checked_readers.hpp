// VTK's readers of XML, where they take on trust what a piece says of its counts and arrays.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <string>
#include <vector>

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
  int ReadPieceData() override;

 private:
  bool has_broken_faces();
  vtkSmartPointer<vtkDataArray> values_of(vtkXMLDataElement *array, vtkIdType count);
};

class CheckedPartsReader : public vtkXMLPUnstructuredGridReader {
 public:
  static CheckedPartsReader *New();
  // The files that the one that was read names.
  const std::vector<std::string> &parts() const { return parts_; }
  CheckedPartsReader(const CheckedPartsReader &) = delete;
  CheckedPartsReader &operator=(const CheckedPartsReader &) = delete;

 protected:
  CheckedPartsReader() = default;
  ~CheckedPartsReader() override = default;
  vtkXMLDataReader *CreatePieceReader() override;
  int ReadPrimaryElement(vtkXMLDataElement *primary) override;
  int ReadPieceData() override;
  void CopyArrayForPoints(vtkAbstractArray *from, vtkAbstractArray *to) override;
  void CopyArrayForCells(vtkAbstractArray *from, vtkAbstractArray *to) override;

 private:
  void find_parts(vtkXMLDataElement &primary);

  std::vector<std::string> parts_;
};

}  // namespace cli
