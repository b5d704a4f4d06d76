#include "magnitude.hpp"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cmath>

namespace cli {
namespace {

bool are_vectors(vtkDataArray *array) {
  return array != nullptr && array->GetName() != nullptr && array->GetNumberOfComponents() > 1 &&
         array->GetNumberOfComponents() <= 3;
}

bool has_scalars(vtkPointData &data) {
  for (int i = 0; i < data.GetNumberOfArrays(); i++)
    if (data.GetArray(i) != nullptr && data.GetArray(i)->GetNumberOfComponents() == 1) return true;
  return false;
}

vtkDataArray *first_vectors(vtkPointData &data) {
  if (are_vectors(data.GetVectors())) return data.GetVectors();
  for (int i = 0; i < data.GetNumberOfArrays(); i++)
    if (are_vectors(data.GetArray(i))) return data.GetArray(i);
  return nullptr;
}

// A NaN of a component that no other one hides.
double magnitude_of(vtkDataArray &vectors, vtkIdType point) {
  double sum = 0;
  for (int c = 0; c < vectors.GetNumberOfComponents(); c++) {
    const double x = vectors.GetComponent(point, c);
    if (std::isnan(x)) return x;
    sum = std::hypot(sum, x);
  }
  return sum;
}

std::string name_of_magnitude(vtkDataArray &vectors) { return std::string(vectors.GetName()) + " magnitude"; }

void add_magnitude(vtkDataArray &vectors, vtkPointData &data) {
  vtkNew<vtkDoubleArray> magnitudes;
  magnitudes->SetName(name_of_magnitude(vectors).c_str());
  magnitudes->SetNumberOfValues(vectors.GetNumberOfTuples());
  for (vtkIdType p = 0; p < vectors.GetNumberOfTuples(); p++) magnitudes->SetValue(p, magnitude_of(vectors, p));
  data.AddArray(magnitudes);
}

}  // namespace

std::string steering_name(const std::string &field, vtkUnstructuredGrid &grid, std::vector<std::string> &notes) {
  vtkPointData &data = *grid.GetPointData();
  vtkDataArray *vectors = data.GetArray(field.c_str());
  if (field.empty()) vectors = has_scalars(data) ? nullptr : first_vectors(data);
  if (!are_vectors(vectors)) return field;
  const std::string name = name_of_magnitude(*vectors);
  const bool has_it = data.HasArray(name.c_str());  // as a file that the tool has written may
  notes.push_back("the vectors '" + std::string(vectors->GetName()) + "' steer by " +
                  (has_it ? "the file's array '" + name + "'" : "their magnitude"));
  if (!has_it) add_magnitude(*vectors, data);
  return name;
}

}  // namespace cli
