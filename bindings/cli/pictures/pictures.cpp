#include "pictures.hpp"

#include <filesystem>

#include "failure.hpp"
#include "figure.hpp"
#include "html_report.hpp"
#include "interrupt.hpp"
#include "output_file.hpp"
#include "stopwatch.hpp"

namespace cli {
namespace {

void write_whole(const std::string &path, const std::string &bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.keep();
}

std::string drawn_on(const Figure &figure, const Theme &theme) {
  stop_if_interrupted();
  Canvas page(figure.width, figure.height, theme);
  figure.draw(page);
  return png_of(page.image());
}

DrawnFigure drawn(const Figure &figure) {
  return {figure.name, figure.title, figure.caption, drawn_on(figure, light_theme()), drawn_on(figure, dark_theme()),
          figure.width};
}

std::vector<DrawnFigure> all_figures(const Pair &pair) {
  const View view = view_of(pair);
  std::vector<DrawnFigure> figures;
  figures.push_back(drawn(surface_figure(pair, view)));
  figures.push_back(drawn(isosurface_figure(pair, view)));
  figures.push_back(drawn(volume_figure(pair, view)));
  figures.push_back(drawn(slice_figure(pair)));
  figures.push_back(drawn(histogram_figure(pair)));
  return figures;
}

}  // namespace

void PicturesFolder::make(const std::string &folder) {
  using Path = std::filesystem::path;
  std::error_code error;
  for (Path path = folder; !path.empty() && !std::filesystem::exists(path, error); path = path.parent_path())
    made_.push_back(path);
  std::filesystem::create_directories(folder, error);
  if (error) throw Failure(folder + ": cannot be made: " + error.message());
  const OutputFile probe((Path(folder) / "report.html").string());
}

PicturesFolder::~PicturesFolder() {
  std::error_code not_empty;
  for (const std::filesystem::path &path : made_) std::filesystem::remove(path, not_empty);
}

void write_pictures(const Arguments &arguments, vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified,
                    const std::string &field, const vtkTetlodSimplify &filter, ToolSeconds &seconds) {
  Stopwatch watch;
  const std::filesystem::path folder(arguments.pictures);
  const Pair pair = pair_of(original, simplified, field, run_report(filter.GetContext()));
  const std::vector<DrawnFigure> figures = all_figures(pair);
  for (const DrawnFigure &figure : figures) {
    write_whole((folder / (figure.name + ".png")).string(), figure.light);
    write_whole((folder / (figure.name + "-dark.png")).string(), figure.dark);
  }
  seconds.pictures = watch.lap();
  write_whole((folder / "report.html").string(),
              html_report(arguments, label_of(*pair.original.values, field), filter, seconds, figures));
}

}  // namespace cli
