#include "figure.hpp"

#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "colour_map.hpp"
#include "raster.hpp"

namespace cli {
namespace {

constexpr int kIsoBins = 64;
constexpr std::size_t kLongestName = 24;  // with a unit it fits beside a colour bar

std::vector<double> finite_values(vtkDataArray &values) {
  std::vector<double> finite;
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); i++) {
    if (std::isfinite(values.GetTuple1(i))) finite.push_back(values.GetTuple1(i));
  }
  return finite;
}

std::string axis_of(const Scale &scale, double least, const std::string &label) {
  if (!scale.logarithmic) return label;
  return label + ", logarithmic" + (least < scale.low ? ", all below at the left end" : "");
}

}  // namespace

std::string label_of(vtkDataArray &values, const std::string &name) {
  if (!values.HasInformation() || !values.GetInformation()->Has(vtkDataArray::UNITS_LABEL())) return name;
  return name + " [" + values.GetInformation()->Get(vtkDataArray::UNITS_LABEL()) + "]";
}

Pair pair_of(vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified, const std::string &field,
             const tetlod_run_report &run) {
  Pair pair{sight_of(original, field), sight_of(simplified, field), {}, {}, {}, 0, true, {}};
  const std::vector<double> values = finite_values(*pair.original.values);
  const double least = values.empty() ? 0 : *std::min_element(values.begin(), values.end());
  pair.label = label_of(*pair.original.values, shortened(field, kLongestName));
  pair.scale = scale_for(values);
  pair.axis = axis_of(pair.scale, least, pair.label);
  pair.range = pair.scale.high - least;
  pair.whole = vtkIdType(values.size()) == pair.original.values->GetNumberOfTuples();
  char share[32];
  std::snprintf(share, sizeof share, "%.3g", 100.0 * double(run.tets_out) / double(run.tets_in));
  pair.captions[0] = "original: " + count_text(run.tets_in) + " tets";
  pair.captions[1] = "simplified: " + count_text(run.tets_out) + " tets, " + share + " %";
  return pair;
}

View view_of(const Pair &pair) { return best_view(surface_of(pair.original), kPanelWidth, 460); }

void draw_no_colour(Canvas &page, const std::string &meaning, int y) {
  constexpr int left = kBarLeft + kBarWidth + 60, size = 16;
  page.rectangle(left, y, size, size, no_colour());
  page.text(meaning, left + 1.5 * size, y + size / 2.0, size);
}

Image shadow_of(const Shape &surface, const View &view) {
  constexpr double opacity = 0.14;
  Raster raster(view.width, view.height, 2);
  raster.draw_triangles(surface, view);
  Image image = raster.image([](const Raster::Sample &) { return Colour{0.6, 0.6, 0.6}; });
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    image.rgba[i] = static_cast<std::uint8_t>(opacity * image.rgba[i] + 0.5);
  return image;
}

std::vector<long long> histogram_of(vtkDataArray &values, const Scale &scale, int bins) {
  std::vector<long long> counts(std::size_t(bins), 0);
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); i++) {
    const double value = values.GetTuple1(i);
    if (std::isfinite(value)) counts[std::min(std::size_t(scale.share(value) * bins), counts.size() - 1)]++;
  }
  return counts;
}

std::vector<double> iso_values(const Pair &pair) {
  const auto counts = histogram_of(*pair.original.values, pair.scale, kIsoBins);
  double whole = 0, sum = 0;
  for (const long long count : counts) whole += std::log2(1.0 + double(count));
  std::vector<double> values;
  for (std::size_t bin = 0; bin < counts.size(); bin++) {
    sum += std::log2(1.0 + double(counts[bin]));
    while (values.size() < 3 && sum >= whole * double(values.size() + 1) / 4) {
      const double value = pair.scale.value((double(bin) + 0.5) / kIsoBins);
      if (!values.empty() && values.back() == value) break;
      values.push_back(value);
    }
  }
  return values;
}

}  // namespace cli
