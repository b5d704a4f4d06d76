// VTK's arrays as the library takes them.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include "tetlod.h"

namespace cli {

// The array itself where it is one of floats or doubles, interleaved; otherwise a copy in doubles.
vtkSmartPointer<vtkDataArray> as_reals(vtkDataArray *array);

// The array's own memory, in tuples of so many components: floats, doubles, 32 or 64 bit integers, interleaved.
tetlod_array borrowed(vtkDataArray *array, int32_t components);

}  // namespace cli
