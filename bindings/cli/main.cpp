// tetlod: simplifies a mesh file. Reads, calls the library, writes, tells.
#include <vtkNew.h>
#include <vtkPoints.h>

#include <iostream>
#include <new>

#include "arguments.hpp"
#include "arrays.hpp"
#include "failure.hpp"
#include "grid_cells.hpp"
#include "interrupt.hpp"
#include "output_file.hpp"
#include "progress_bar.hpp"
#include "quiet_vtk.hpp"
#include "read_grid.hpp"
#include "report.hpp"
#include "simplify.hpp"
#include "steering_field.hpp"
#include "stopwatch.hpp"
#include "table2.h"
#include "write_grid.hpp"

namespace cli {
namespace {

using Notes = std::vector<std::string>;

TetMesh read_mesh(const Arguments &arguments, VtkMessages &messages, Notes &notes) {
  const auto grid = read_grid(arguments.input, messages, notes);
  vtkDataArray *field = steering_field(*grid, arguments.field);
  TetMesh mesh;
  mesh.field = field->GetName() != nullptr ? field->GetName() : "scalars";
  mesh.values = as_reals(field);
  mesh.points = as_reals(grid->GetPoints()->GetData());
  const Tets tets = tets_of(*grid, notes);
  mesh.corners = tets.corners;
  mesh.others = carried_arrays(*grid, field, tets, notes);
  messages.check(arguments.input, notes);
  return mesh;
}

void print_notes(const Arguments &arguments, const Notes &notes) {
  if (arguments.quiet) return;
  for (const std::string &note : notes) std::cerr << "tetlod: note: " << one_line(note) << '\n';
}

void print_table(const Arguments &arguments, const TetMesh &mesh, const tetlod_context *context,
                 const tetlod_error_report &error, const ToolSeconds &seconds) {
  if (arguments.quiet) return;
  std::cout << arguments.input << " -> " << arguments.output << ", field " << mesh.field << std::endl;
  const table2_seconds around = {seconds.reading, -1.0, seconds.writing};
  check(table2_print(stdout, context, &error, &around), context);
}

void run(const Arguments &arguments) {
  // Everything that can be known to fail fails before the work is done.
  const Context context = make_context(arguments);
  OutputFile result(arguments.output);
  std::optional<OutputFile> report;
  if (!arguments.report.empty()) report.emplace(arguments.report);
  vtkNew<VtkMessages> messages;
  messages->install();
  ProgressBar bar(arguments.quiet);
  Notes notes;
  ToolSeconds seconds;
  Stopwatch watch;

  bar.show("read", 0.0);
  const TetMesh mesh = read_mesh(arguments, *messages, notes);
  seconds.reading = watch.lap();
  stop_if_interrupted();
  simplify(context.get(), mesh, bar, notes);
  watch.lap();
  const tetlod_error_report error = measure(context.get());
  seconds.measuring = watch.lap();
  write_grid(result.temporary(), context.get(), mesh, *messages, notes);
  seconds.writing = watch.lap();
  stop_if_interrupted();
  if (report) write_report(report->temporary(), arguments, mesh.field, context.get(), error, seconds);
  result.keep();
  if (report) report->keep();
  bar.clear();
  print_notes(arguments, notes);
  print_table(arguments, mesh, context.get(), error, seconds);
}

int fail(const std::string &message, ExitStatus status) {
  std::cerr << "tetlod: " << one_line(message) << std::endl;
  return status;
}

}  // namespace
}  // namespace cli

int main(int argc, char **argv) {
  using namespace cli;
  try {
    watch_interrupts();
    const std::optional<Arguments> arguments = parse_arguments(argc, argv);
    if (arguments) run(*arguments);
    return kDone;
  } catch (const Failure &failure) {
    return fail(failure.what(), failure.status());
  } catch (const std::bad_alloc &) {
    return fail("not enough memory", kFailed);
  } catch (const std::exception &error) {
    return fail(error.what(), kFailed);
  }
}
