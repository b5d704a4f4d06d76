#include "notes.hpp"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <sstream>

#include "report.hpp"

namespace cli {
namespace {

bool is_given(const Arguments &arguments, const char *option) {
  return arguments.numbers.count(tetlod_option_from_name(option)) > 0;
}

void note_unused_options(vtkTetlodSimplify &filter, const Arguments &arguments, std::vector<std::string> &notes) {
  const bool has_size = filter.GetOption("target-ratio") > 0 || filter.GetOption("max-error") > 0;
  const std::string size = "--target-ratio or --max-error";
  if (has_size && filter.GetOption("remesh") == 0 && filter.GetOption("clean-edges") > 0)
    notes.push_back("--clean-edges has no meaning with --remesh 0");
  for (const char *name : {"rho", "sigma", "lambda", "min-distance"})
    if (has_size && is_given(arguments, name))
      notes.push_back(std::string("--") + name + " has no meaning with " + size);
  if (!has_size && is_given(arguments, "effort")) notes.push_back("--effort has no meaning without " + size);
  if (!has_size && arguments.preset.value_or(TETLOD_PRESET_PAPER) != TETLOD_PRESET_PAPER)
    notes.push_back("--target-ratio 0 makes of any preset the paper's; " + size + " belongs to the others");
}

// "; --field takes another: a, b"; nothing where there is none.
std::string other_fields(vtkPointData &data, const std::string &field) {
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkDataArray *array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr || array->GetName() == field) continue;
    if (array->GetNumberOfComponents() <= 3) names += (names.empty() ? "" : ", ") + std::string(array->GetName());
  }
  return names.empty() ? "" : "; --field takes another: " + names;
}

bool has_whole_numbers(vtkDataArray *array) {
  return array != nullptr && array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
}

// One that says nothing of where tets are needed, or that is hardly meant.
void note_field(vtkTetlodSimplify &filter, const Arguments &arguments, std::vector<std::string> &notes) {
  vtkPointData &data = *vtkUnstructuredGrid::SafeDownCast(filter.GetInputDataObject(0, 0))->GetPointData();
  const std::string field = filter.GetOutput()->GetPointData()->GetScalars()->GetName();
  const tetlod_run_report report = run_report(filter.GetContext());
  std::string what;
  if (report.scalar_min == report.scalar_max)
    what = "is constant: shape alone decided";
  else if (arguments.field.empty() && has_whole_numbers(data.GetArray(field.c_str())))
    what = "has whole numbers, as names of points do";
  if (!what.empty()) notes.push_back("the field '" + field + "' " + what + other_fields(data, field));
}

void note_missed_size(vtkTetlodSimplify &filter, std::vector<std::string> &notes) {
  constexpr double usual = 1.03;  // what is within that is met
  const double asked = filter.GetOption("target-ratio");
  if (asked <= 0 || filter.GetOption("max-error") > 0) return;
  const tetlod_run_report report = run_report(filter.GetContext());
  const double kept = static_cast<double>(report.tets_out) / static_cast<double>(report.tets_in - report.dropped_tets);
  if (kept <= usual * asked) return;
  std::ostringstream text;
  text << "a part of " << asked << " of the tets was asked for, and " << kept
       << " is left: no way to less was found that keeps the topology";
  if (filter.GetOption("max-deviation") > 0) text << " and max-deviation";
  if (filter.GetOption("remesh") == 0) text << "; --remesh 1 may lead to less";
  notes.push_back(text.str());
}

}  // namespace

void add_notes(vtkTetlodSimplify &filter, const Arguments &arguments, std::vector<std::string> &notes) {
  note_field(filter, arguments, notes);
  note_unused_options(filter, arguments, notes);
  note_missed_size(filter, notes);
}

}  // namespace cli
