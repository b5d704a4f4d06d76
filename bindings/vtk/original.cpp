#include "original.hpp"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkPointData.h>

#include <stdexcept>

#include "carried_arrays.hpp"
#include "middles.hpp"
#include "steering_field.hpp"

namespace tetlod_vtk {
namespace {

// VTK's readers take a file's word for it.
void require_tuples(vtkDataSetAttributes &data, vtkIdType count, const std::string &what) {
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkAbstractArray *const array = data.GetAbstractArray(i);
    const std::string name = array->GetName() != nullptr ? array->GetName() : "";
    if (const vtkIdType tuples = array->GetNumberOfTuples(); tuples != count)
      throw std::runtime_error("array '" + name + "': " + std::to_string(tuples) + " tuples for " +
                               std::to_string(count) + " " + what);
  }
}

// The name that SetInputArrayToProcess was given; empty: none.
std::string wanted_name(vtkInformation *wanted) {
  if (wanted == nullptr || !wanted->Has(vtkDataObject::FIELD_NAME())) return "";
  return wanted->Get(vtkDataObject::FIELD_NAME());
}

vtkDataArray *steering_array(vtkUnstructuredGrid &grid, vtkInformation *wanted) {
  const std::string name = wanted_name(wanted);
  if (!name.empty() && wanted->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    throw std::runtime_error("field '" + name + "' is asked for as cell data; a point array steers");
  return steering_field(grid, name);
}

vtkUnsignedCharArray *flags_array(vtkUnstructuredGrid &grid, vtkInformation *wanted) {
  const std::string name = wanted_name(wanted);
  if (name.empty()) return nullptr;
  if (wanted->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
    throw std::runtime_error("point flags '" + name + "' are asked for as cell data");
  auto *flags = vtkUnsignedCharArray::SafeDownCast(grid.GetPointData()->GetAbstractArray(name.c_str()));
  if (flags == nullptr || flags->GetNumberOfComponents() != 1)
    throw std::runtime_error("point flags '" + name + "' are not a point array of one unsigned char");
  return flags;
}

// One without a name gets one that no other has.
std::string name_of(vtkDataArray &field, vtkPointData &data) {
  const bool is_named = field.GetName() != nullptr && *field.GetName() != 0;
  return is_named ? field.GetName() : name_of_none(data, "scalars");
}

// The array of others that steers, too.
CarriedArray &further_array(vtkUnstructuredGrid &grid, const std::string &name, OriginalArrays &arrays) {
  if (steering_field(grid, name) == arrays.steering)
    throw std::runtime_error("field '" + name + "' steers already: it is the first");
  for (CarriedArray &other : arrays.others)
    if (other.original->GetName() == name) return other;
  throw std::runtime_error("field '" + name +
                           "' cannot steer: ghost marks and global numbers mean nothing on a result");
}

// Separate coordinates are submitted as such.
LentArray lend_points(vtkDataArray *points) {
  if (lend_component(points, 0).array.data != nullptr) return {};
  return lend_reals(points);
}

void submit_points(tetlod::Context &context, const Original &original) {
  if (original.points.keeper != nullptr)
    return require(tetlod_submit_points(context.get(), &original.points.array), context);
  vtkDataArray *points = original.grid->GetPoints()->GetData();
  const LentArray x = lend_component(points, 0), y = lend_component(points, 1), z = lend_component(points, 2);
  require(tetlod_submit_points_xyz(context.get(), &x.array, &y.array, &z.array), context);
}

void submit_other(tetlod::Context &context, const CarriedArray &other) {
  const tetlod_array *const values = &other.reals.array;
  require(other.weight > 0 ? tetlod_submit_steering(context.get(), other.name(), other.weight, values)
                           : tetlod_submit_field(context.get(), other.name(), TETLOD_POINT_FIELD, values),
          context);
}

}  // namespace

Original original_of(vtkUnstructuredGrid *input, vtkInformation *steering, const std::vector<WeightedArray> &further,
                     vtkInformation *flags, std::vector<std::string> &notes) {
  Original original;
  if (input->GetPoints() == nullptr) throw std::runtime_error("the grid has no points");
  require_tuples(*input->GetPointData(), input->GetNumberOfPoints(), "points");
  require_tuples(*input->GetCellData(), input->GetNumberOfCells(), "cells");
  original.grid = cut_around_middles(input, wanted_name(flags), notes);
  vtkDataArray *field = steering_array(*original.grid, steering);
  original.arrays.flags = flags_array(*original.grid, flags);
  original.tets = tets_of(*original.grid, notes);
  original.is_split = original.tets.cells != nullptr || original.grid != input;
  original.values = lend_reals(field);
  original.points = lend_points(original.grid->GetPoints()->GetData());
  original.arrays.points = original.grid->GetPoints()->GetData();
  original.arrays.steering = field;
  original.arrays.name = name_of(*field, *original.grid->GetPointData());
  original.arrays.others = carried_arrays(*original.grid, {field, original.arrays.flags}, notes);
  original.arrays.of_cells = cell_arrays(*original.grid, original.tets, notes);
  for (const WeightedArray &array : further)
    further_array(*original.grid, array.name, original.arrays).weight = array.weight;
  return original;
}

void submit(tetlod::Context &context, const Original &original) {
  const tetlod_array corners = room_in(original.tets.corners, 4);
  submit_points(context, original);
  require(tetlod_submit_tets(context.get(), &corners, 0), context);
  require(tetlod_submit_scalars(context.get(), original.arrays.name.c_str(), &original.values.array), context);
  for (const CarriedArray &other : original.arrays.others) submit_other(context, other);
  if (const CellArrays &cells = original.arrays.of_cells; cells.numbers.keeper != nullptr)
    require(tetlod_submit_field(context.get(), cells.name_of_numbers.c_str(), TETLOD_CELL_FIELD, &cells.numbers.array),
            context);
  if (original.arrays.flags == nullptr) return;
  const tetlod_array flags = room_in(original.arrays.flags, 1);
  require(tetlod_submit_point_flags(context.get(), &flags), context);
}

void run(tetlod::Context &context, const Original &original) {
  try {
    context.run();
  } catch (const tetlod::Error &error) {
    const std::string message = error.what();
    if (!original.is_split || message.find("tet ") == std::string::npos) throw;
    throw tetlod::Error(error.status(), message + " (of the tets that the grid's solid cells are split into)");
  }
}

}  // namespace tetlod_vtk
