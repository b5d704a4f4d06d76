#include "vtkTetlodSimplify.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkErrorCode.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkTimeStamp.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "original.hpp"
#include "result_grid.hpp"
#include "tetlod.hpp"

vtkStandardNewMacro(vtkTetlodSimplify);

namespace {

constexpr int32_t kWarning = 2;
constexpr int kStages = 7;  // as many as tetlod_stage_name knows

// What was submitted is forgotten when an execution ends, however it ends: the arrays are the pipeline's.
class ClearAtEnd {
 public:
  explicit ClearAtEnd(tetlod::Context &context) : context_(context) {}
  ~ClearAtEnd() { tetlod_clear(context_.get()); }
  ClearAtEnd(const ClearAtEnd &) = delete;
  ClearAtEnd &operator=(const ClearAtEnd &) = delete;

 private:
  tetlod::Context &context_;
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

int32_t option_named(const char *name) {
  const int32_t option = name != nullptr ? tetlod_option_from_name(name) : 0;
  if (option == 0) throw tetlod::Error(TETLOD_ERR_OPTION, std::string("no option '") + (name ? name : "") + "'");
  return option;
}

// VTK's writers take cells and points for granted, be there none of them.
void make_empty(vtkUnstructuredGrid &grid) {
  grid.Initialize();
  grid.SetPoints(vtkNew<vtkPoints>());
  grid.SetCells(VTK_TETRA, vtkNew<vtkCellArray>());
}

bool is_integer(int32_t option) { return tetlod::option_bounds(option).is_integer != 0; }

}  // namespace

struct vtkTetlodSimplify::Internals {
  tetlod::Context context;
  std::vector<tetlod_vtk::WeightedArray> steering;  // beside input array 0
  tetlod_error_report error{};
  double seconds_of_run = 0, seconds_of_measuring = 0;
  bool aborted = false;  // the last execution
  vtkTimeStamp since_abort;
};

vtkTetlodSimplify::vtkTetlodSimplify() : Inside(std::make_unique<Internals>()) {
  tetlod::Context &context = this->Inside->context;
  context.set_int(TETLOD_OPT_THREADS, 0);
  context.set_progress([this](int32_t stage, double fraction) { return this->OnProgress(stage, fraction); });
  context.set_log([this](int32_t, const char *message) { vtkWarningMacro(<< message); }, kWarning);
}

vtkTetlodSimplify::~vtkTetlodSimplify() = default;

// ---- Properties ----

void vtkTetlodSimplify::SetOption(const char *name, double value) {
  tetlod::Context &context = this->Inside->context;
  try {
    const int32_t option = option_named(name);
    const bool integer = is_integer(option);
    constexpr double largest_integer = 9007199254740992;  // up to which doubles have all
    if (integer && !(std::abs(value) <= largest_integer && value == std::floor(value)))
      throw tetlod::Error(TETLOD_ERR_OPTION, std::string(name) + ": " + std::to_string(value) + " is not an integer");
    const double before = this->GetOption(name);
    if (integer)
      context.set_int(option, static_cast<int64_t>(value));
    else
      context.set_real(option, value);
    if (value != before) this->Modified();  // the same one is set, too: a ratio is no preset's any more then
  } catch (const tetlod::Error &error) {
    this->Fail(error.status(), error.what());
  }
}

double vtkTetlodSimplify::GetOption(const char *name) {
  const tetlod::Context &context = this->Inside->context;
  try {
    const int32_t option = option_named(name);
    return is_integer(option) ? static_cast<double>(context.get_int(option)) : context.get_real(option);
  } catch (const tetlod::Error &error) {
    this->Fail(error.status(), error.what());
    return 0;
  }
}

void vtkTetlodSimplify::SetPreset(int preset) {
  try {
    this->Inside->context.set_preset(preset);
    this->Modified();
  } catch (const tetlod::Error &error) {
    this->Fail(error.status(), error.what());
  }
}

// Whether the weights and their number will do is the library's to say.
void vtkTetlodSimplify::AddSteeringArray(const char *name, double weight) {
  Internals &in = *this->Inside;
  std::vector<tetlod_vtk::WeightedArray> steering = in.steering;
  const std::string wanted = name != nullptr ? name : "";
  const auto same =
      std::find_if(steering.begin(), steering.end(), [&](const auto &array) { return array.name == wanted; });
  if (same != steering.end())
    same->weight = weight;
  else
    steering.push_back({wanted, weight});
  try {
    const ClearAtEnd clear(in.context);
    const double none = 0;
    for (const tetlod_vtk::WeightedArray &array : steering)
      in.context.submit_steering(array.name, array.weight, {&none, 0});
    in.steering = steering;
    this->Modified();
  } catch (const tetlod::Error &error) {
    this->Fail(error.status(), error.what());
  }
}

void vtkTetlodSimplify::ClearSteeringArrays() {
  this->Inside->steering.clear();
  this->Modified();
}

// A property is an option under VTK's name; the defaults and bounds are the library's.
#define TETLOD_PROPERTY(Name, Type, option)                                                              \
  void vtkTetlodSimplify::Set##Name(Type value) { this->SetOption(option, static_cast<double>(value)); } \
  Type vtkTetlodSimplify::Get##Name() { return static_cast<Type>(this->GetOption(option)); }

TETLOD_PROPERTY(Rho, double, "rho")
TETLOD_PROPERTY(Sigma, double, "sigma")
TETLOD_PROPERTY(Lambda, double, "lambda")
TETLOD_PROPERTY(MinDistance, double, "min-distance")
TETLOD_PROPERTY(MergeTolerance, double, "merge-tolerance")
TETLOD_PROPERTY(CleanEdges, double, "clean-edges")
TETLOD_PROPERTY(BoundaryLeaf, vtkTypeInt64, "boundary-leaf")
TETLOD_PROPERTY(TetLeaf, vtkTypeInt64, "tet-leaf")
TETLOD_PROPERTY(TargetRatio, double, "target-ratio")
TETLOD_PROPERTY(Effort, vtkTypeInt64, "effort")
TETLOD_PROPERTY(Remesh, bool, "remesh")
TETLOD_PROPERTY(MaxError, double, "max-error")
TETLOD_PROPERTY(MaxDeviation, double, "max-deviation")
TETLOD_PROPERTY(Threads, vtkTypeInt64, "threads")
TETLOD_PROPERTY(Seed, vtkTypeInt64, "seed")
TETLOD_PROPERTY(TimeLimit, double, "time-limit")
TETLOD_PROPERTY(RepairCoincident, bool, "on-coincident")
TETLOD_PROPERTY(RepairRepeated, bool, "on-repeated")
TETLOD_PROPERTY(RepairFlat, bool, "on-flat")
TETLOD_PROPERTY(RepairInverted, bool, "on-inverted")
TETLOD_PROPERTY(RepairDuplicate, bool, "on-duplicate")
TETLOD_PROPERTY(RepairOverlap, bool, "on-overlap")
TETLOD_PROPERTY(RepairUnused, bool, "on-unused")
TETLOD_PROPERTY(RepairNonfinite, bool, "on-nonfinite")
#undef TETLOD_PROPERTY

// ---- The last execution ----

double vtkTetlodSimplify::GetErrorRMS() {
  return this->GetErrorReport().struct_size > 0 ? this->GetErrorReport().rms : -1;
}
double vtkTetlodSimplify::GetErrorMaximum() {
  return this->GetErrorReport().struct_size > 0 ? this->GetErrorReport().max : -1;
}
double vtkTetlodSimplify::GetErrorOutside() {
  return this->GetErrorReport().struct_size > 0 ? this->GetErrorReport().outside : -1;
}
double vtkTetlodSimplify::GetSecondsOfRun() { return this->Inside->seconds_of_run; }
double vtkTetlodSimplify::GetSecondsOfMeasuring() { return this->Inside->seconds_of_measuring; }
tetlod_context *vtkTetlodSimplify::GetContext() const { return this->Inside->context.get(); }
const tetlod_error_report &vtkTetlodSimplify::GetErrorReport() const { return this->Inside->error; }

// ---- Execution ----

// Of all stages as equal parts, never backwards: a stage may come again when remeshing asks for it.
bool vtkTetlodSimplify::OnProgress(int stage, double fraction) {
  const double whole = std::min(1.0, (stage + std::clamp(fraction, 0.0, 1.0)) / kStages);
  this->SetProgressText(tetlod::stage_name(stage));
  this->UpdateProgress(std::max(whole, this->GetProgress()));
  return this->GetAbortExecute() != 0;
}

void vtkTetlodSimplify::Execute(vtkUnstructuredGrid *input, vtkUnstructuredGrid *output) {
  Internals &in = *this->Inside;
  std::vector<std::string> notes;
  const tetlod_vtk::Original original = tetlod_vtk::original_of(input, this->GetInputArrayInformation(0), in.steering,
                                                                this->GetInputArrayInformation(1), notes);
  for (const std::string &note : notes) vtkWarningMacro(<< note);
  const ClearAtEnd clear(in.context);
  tetlod_vtk::submit(in.context, original);
  const Stopwatch run;
  tetlod_vtk::run(in.context, original);
  in.seconds_of_run = run.seconds();
  if (this->MeasureError) {
    const Stopwatch measuring;
    in.error = in.context.measure_error(1);
    in.seconds_of_measuring = measuring.seconds();
  }
  tetlod_vtk::fill_result(in.context, original.arrays, *output);
}

// Newer than whatever was made since an abort, here and behind, so that the next update runs again.
vtkMTimeType vtkTetlodSimplify::GetMTime() {
  Internals &in = *this->Inside;
  if (in.aborted) in.since_abort.Modified();
  return std::max(this->Superclass::GetMTime(), in.since_abort.GetMTime());
}

int vtkTetlodSimplify::RequestData(vtkInformation *, vtkInformationVector **inputs, vtkInformationVector *outputs) {
  vtkUnstructuredGrid *input = vtkUnstructuredGrid::GetData(inputs[0]), *output = vtkUnstructuredGrid::GetData(outputs);
  Internals &in = *this->Inside;
  in.error = {};
  in.seconds_of_run = in.seconds_of_measuring = 0;
  in.aborted = false;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (input == nullptr || input->GetNumberOfCells() == 0) {
    make_empty(*output);
    return 1;
  }
  tetlod_status status = TETLOD_ERR_ARGUMENT;
  std::string message;
  try {
    this->Execute(input, output);
    return 1;
  } catch (const tetlod::Error &error) {
    status = error.status();
    message = error.what();
  } catch (const std::exception &error) {
    message = error.what();
  }
  make_empty(*output);
  in.aborted = status == TETLOD_ERR_CANCELLED && this->GetAbortExecute() != 0;
  if (in.aborted) return 1;
  this->Fail(status, message.c_str());
  return 0;
}

void vtkTetlodSimplify::Fail(int status, const char *message) {
  this->ErrorCode = static_cast<unsigned long>(vtkErrorCode::UserError + status);  // which is no modification
  vtkErrorMacro(<< message);
}

void vtkTetlodSimplify::PrintSelf(ostream &os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  for (int32_t option = 1; tetlod::option_name(option) != nullptr; option++)
    os << indent << tetlod::option_name(option) << ": " << this->GetOption(tetlod::option_name(option)) << '\n';
  for (const tetlod_vtk::WeightedArray &array : this->Inside->steering)
    os << indent << "SteeringArray: " << array.name << " " << array.weight << '\n';
  os << indent << "MeasureError: " << (this->MeasureError ? "on" : "off") << '\n';
}
