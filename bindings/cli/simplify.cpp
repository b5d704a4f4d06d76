#include "simplify.hpp"

#include <vtkCommand.h>
#include <vtkDataObject.h>

#include <set>

#include "cell_means.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "magnitude.hpp"

namespace cli {

namespace {

std::string point_data_for(const std::string &field, vtkUnstructuredGrid &grid, std::vector<std::string> &notes) {
  add_means_of_cells(field, grid, notes);
  return steering_name(field, grid, notes);
}

}  // namespace

void check(tetlod_status status, const tetlod_context *context) {
  if (status == TETLOD_OK) return;
  std::string text(tetlod_last_message(context, nullptr, 0), '\0');
  tetlod_last_message(context, text.data(), text.size() + 1);
  throw Failure(text.empty() ? tetlod_status_text(status) : text);
}

vtkSmartPointer<vtkTetlodSimplify> make_filter(const Arguments &arguments, VtkMessages &messages) {
  auto filter = vtkSmartPointer<vtkTetlodSimplify>::New();
  filter->SetMeasureError(!arguments.quiet || !arguments.report.empty() || !arguments.pictures.empty());
  if (arguments.preset) filter->SetPreset(*arguments.preset);
  for (const auto &[option, value] : arguments.numbers) filter->SetOption(tetlod_option_name(option), value);
  for (const auto &[name, weight] : arguments.steer) filter->AddSteeringArray(name.c_str(), weight);
  std::vector<std::string> notes;
  messages.check("", notes, kWrongUsage);
  if (filter->GetOption("remesh") == 0 && filter->GetOption("target-ratio") <= 0 && filter->GetOption("max-error") <= 0)
    throw Failure("--remesh 0 takes --target-ratio or --max-error", kWrongUsage);
  return filter;
}

vtkUnstructuredGrid *simplify(vtkTetlodSimplify &filter, vtkUnstructuredGrid *original, const Arguments &arguments,
                              ProgressBar &bar, VtkMessages &messages, std::vector<std::string> &notes) {
  const CancelOnInterrupt cancel(filter.GetContext());
  filter.SetInputData(original);
  const std::string field = point_data_for(arguments.field, *original, notes);
  if (!field.empty()) filter.SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, field.c_str());
  filter.ClearSteeringArrays();  // their weights are known to be good; what they are is known now
  std::set<std::string> steering;
  for (const auto &[name, weight] : arguments.steer) {
    const std::string point_data = point_data_for(name, *original, notes);
    if (!steering.insert(point_data).second)  // a magnitude by its own name, too
      throw Failure("--steer: field '" + point_data + "' is given twice", kWrongUsage);
    filter.AddSteeringArray(point_data.c_str(), weight);
  }
  filter.AddObserver(vtkCommand::ProgressEvent, &bar, &ProgressBar::on_progress);
  filter.Update();
  stop_if_interrupted();
  bar.clear();
  messages.check(arguments.input, notes);
  return filter.GetOutput();
}

}  // namespace cli
