// VTK's arrays as the library takes them: in place where the layout allows it.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include "tetlod.h"

namespace tetlod_vtk {

struct LentArray {
  vtkSmartPointer<vtkDataArray> keeper;  // lives as long as the library reads
  tetlod_array array;
};

bool is_real(int vtk_type);

// Tuples of floats or doubles: the array itself where it is interleaved (AOS), or has its components at even distances
// one after another (SOA), which one and two components always are; otherwise a copy in doubles.
LentArray lend_reals(vtkDataArray *array);

// One component of an array that lend_reals would copy for its distances alone. Null data: it would be copied for
// another reason.
LentArray lend_component(vtkDataArray *array, int component);

// An interleaved array of floats, doubles or integers of 32 or 64 bits, to read from or to write results to.
tetlod_array room_in(vtkDataArray *array, int32_t components);

}  // namespace tetlod_vtk
