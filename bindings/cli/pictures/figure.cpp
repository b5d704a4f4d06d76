#include "figure.hpp"

#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cli {
namespace {

constexpr int kIsoBins = 64;

std::string label_of(vtkDataArray &values, const std::string &name) {
  if (!values.HasInformation() || !values.GetInformation()->Has(vtkDataArray::UNITS_LABEL())) return name;
  return name + " [" + values.GetInformation()->Get(vtkDataArray::UNITS_LABEL()) + "]";
}

Scale scale_of(vtkDataArray &values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); i++) {
    const double value = values.GetTuple1(i);
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  return scale_for(low, high);
}

}  // namespace

Pair pair_of(vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified, const std::string &field,
             const tetlod_run_report &run) {
  Pair pair{sight_of(original, field), sight_of(simplified, field), {}, {}, {}};
  pair.label = label_of(*pair.original.values, field);
  pair.scale = scale_of(*pair.original.values);
  char share[32];
  std::snprintf(share, sizeof share, "%.3g", 100.0 * double(run.tets_out) / double(run.tets_in));
  pair.captions[0] = "original: " + count_text(run.tets_in) + " tets";
  pair.captions[1] = "simplified: " + count_text(run.tets_out) + " tets, " + share + " %";
  return pair;
}

View view_of(const Pair &pair) { return best_view(surface_of(pair.original), kPanelWidth, 460); }

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
