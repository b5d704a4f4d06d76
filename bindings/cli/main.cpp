// tetlod: simplifies a mesh file. Reads, runs the filter, writes, tells.
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <new>

#include "arguments.hpp"
#include "dying_reader.hpp"
#include "failure.hpp"
#include "interrupt.hpp"
#include "notes.hpp"
#include "output_file.hpp"
#include "pictures.hpp"
#include "progress_bar.hpp"
#include "quiet_vtk.hpp"
#include "read_grid.hpp"
#include "report.hpp"
#include "simplify.hpp"
#include "stopwatch.hpp"
#include "table2.h"
#include "write_grid.hpp"

namespace cli {
namespace {

using Notes = std::vector<std::string>;

// A full disk may show only when the last of the text leaves its buffer.
void check_printed() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Failure(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void print_notes(const Arguments &arguments, const Notes &notes) {
  if (arguments.quiet) return;
  for (const std::string &note : notes) std::cerr << "tetlod: note: " << one_line(note) << '\n';
}

void print_table(const Arguments &arguments, const std::string &field, const vtkTetlodSimplify &filter,
                 const ToolSeconds &seconds) {
  if (arguments.quiet) return;
  std::cout << arguments.input << " -> " << arguments.output << ", field " << field << '\n';
  const table2_seconds around = {seconds.reading, -1.0, seconds.writing};
  check(table2_print(stdout, filter.GetContext(), &filter.GetErrorReport(), &around), filter.GetContext());
  std::cout << std::fixed << std::setprecision(1) << "Beside that it took " << seconds.measuring
            << " s to measure the error";
  if (!arguments.pictures.empty())
    std::cout << ", and " << seconds.pictures << " s to draw " << arguments.pictures << "/report.html";
  std::cout << '\n';
}

Original read_input(const Arguments &arguments, VtkMessages &messages, Notes &notes) {
  const DyingReader dying(arguments.input);
  return read_grid(arguments.input, messages, notes);
}

void run(const Arguments &arguments) {
  // Everything that can be known to fail fails before the work is done.
  vtkNew<VtkMessages> messages;
  messages->install();
  const auto filter = make_filter(arguments, *messages);
  GridFile result(arguments.output);
  PicturesFolder pictures;
  if (!arguments.pictures.empty()) pictures.make(arguments.pictures);
  std::optional<OutputFile> report;  // which may be in that folder
  if (!arguments.report.empty()) report.emplace(arguments.report);
  ProgressBar bar(arguments.quiet);
  Notes notes;
  ToolSeconds seconds;
  Stopwatch watch;

  bar.show("read", 0.0);
  const auto [original, parts] = read_input(arguments, *messages, notes);
  check_parts(arguments, parts);
  seconds.reading = watch.lap();
  check_arrays(arguments.output, *original);
  stop_if_interrupted();
  vtkUnstructuredGrid *simplified = simplify(*filter, original, arguments, bar, *messages, notes);
  add_notes(*filter, arguments, notes);
  seconds.measuring = filter->GetSecondsOfMeasuring();
  watch.lap();
  result.write(simplified, *messages, notes);
  seconds.writing = watch.lap();
  stop_if_interrupted();
  const std::string field = simplified->GetPointData()->GetScalars()->GetName();
  if (!arguments.pictures.empty()) {
    bar.show("pictures", 0.0);
    write_pictures(arguments, original, simplified, field, *filter, seconds);
  }
  if (report) write_report(*report, arguments, field, *filter, seconds);
  result.keep();
  if (report) report->keep();
  bar.clear();
  print_notes(arguments, notes);
  print_table(arguments, field, *filter, seconds);
  check_printed();
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
    report_full_files();
    const std::optional<Arguments> arguments = parse_arguments(argc, argv);
    if (arguments)
      run(*arguments);
    else
      check_printed();
    return kDone;
  } catch (const Failure &failure) {
    const int status = fail(failure.what(), failure.status());
    if (interrupted()) die_of_interruption();
    return status;
  } catch (const std::bad_alloc &) {
    return fail("not enough memory", kFailed);
  } catch (const std::exception &error) {
    return fail(error.what(), kFailed);
  }
}
