// Histograms of the field before and after, linear and logarithmic [4, Figure 5].
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>

#include "colour_map.hpp"
#include "figure.hpp"

namespace cli {
namespace {

constexpr int kBins = 128, kPlotHeight = 240, kHead = 40, kLeft = 80, kFoot = 64;
constexpr int kPlotWidth = kPanelWidth - kLeft - 40;

std::vector<double> shares_of(vtkDataArray &values, const Scale &scale) {
  const auto counts = histogram_of(values, scale, kBins);
  long long whole = 0;
  for (const long long count : counts) whole += count;
  std::vector<double> shares;
  for (const long long count : counts) shares.push_back(whole > 0 ? 100.0 * double(count) / double(whole) : 0);
  return shares;
}

// A plot's frame: x along the field, y along the shares of the vertices.
struct Plot {
  double left, top;
  Scale x, y;

  double height_of(double share) const {
    if (share <= 0 || (y.logarithmic && share < y.low)) return 0;
    return kPlotHeight * y.share(share);
  }
};

void draw_frame(Canvas &page, const Plot &plot, const std::string &label) {
  for (const double tick : ticks_of(plot.y)) {
    const double y = plot.top + kPlotHeight * (1 - plot.y.share(tick));
    page.rectangle(plot.left, y - 0.5, kPlotWidth, 1, page.theme().faint);
    page.text(number_text(tick) + " %", plot.left - 8, y, 14, Align::right);
  }
  page.rectangle(plot.left, plot.top + kPlotHeight, kPlotWidth, 1, page.theme().ink);
  for (const double tick : ticks_of(plot.x)) {
    const double x = plot.left + kPlotWidth * plot.x.share(tick);
    page.rectangle(x - 0.5, plot.top + kPlotHeight, 1, 5, page.theme().ink);
    page.text(number_text(tick, plot.x), x, plot.top + kPlotHeight + 15, 14, Align::centre);
  }
  page.text(label, plot.left + kPlotWidth / 2.0, plot.top + kPlotHeight + 38, 16, Align::centre);
}

void draw_bars(Canvas &page, const Plot &plot, const std::vector<double> &shares) {
  const double width = double(kPlotWidth) / kBins;
  for (std::size_t bin = 0; bin < shares.size(); bin++) {
    const double height = plot.height_of(shares[bin]);
    if (height > 0)
      page.rectangle(plot.left + double(bin) * width, plot.top + kPlotHeight - std::max(height, 1.0), width - 0.6,
                     std::max(height, 1.0), mixed(field_colour((double(bin) + 0.5) / kBins), page.theme().ink, 0.15));
  }
}

}  // namespace

Figure histogram_figure(const Pair &pair) {
  const std::vector<double> shares[2] = {shares_of(*pair.original.values, pair.scale),
                                         shares_of(*pair.simplified.values, pair.scale)};
  double most = 0;
  for (const auto &side : shares) most = std::max(most, *std::max_element(side.begin(), side.end()));
  const double one = 100.0 / double(std::max<vtkIdType>(1, pair.original.values->GetNumberOfTuples()));
  const Scale linear{0, most > 0 ? most : 1, false}, logarithmic{0.7 * one, std::max(most, 2 * one), true};
  Figure figure{"histograms", "Histograms", "", kPageWidth, 2 * (kHead + kPlotHeight + kFoot), {}};
  figure.caption = "How many of the vertices have which value, in " + std::to_string(kBins) +
                   " parts of the field's range (the paper's Figure 5): above with a linear, below with a logarithmic "
                   "axis, which ends at "
                   "one vertex of the original.";
  figure.draw = [pair, before = shares[0], after = shares[1], linear, logarithmic](Canvas &page) {
    for (int row = 0; row < 2; row++) {
      for (int side = 0; side < 2; side++) {
        const int left = side == 0 ? 0 : kPageWidth - kPanelWidth, top = row * (kHead + kPlotHeight + kFoot);
        const Plot plot{double(left + kLeft), double(top + kHead), pair.scale, row == 0 ? linear : logarithmic};
        page.text(pair.captions[side] + (row == 0 ? "" : ", logarithmic"), left + kLeft + kPlotWidth / 2.0,
                  top + kHead / 2.0, kCaptionSize, Align::centre, true);
        page.text("vertices", plot.left - 8, top + kHead / 2.0, 14, Align::right);
        draw_frame(page, plot, pair.axis);
        draw_bars(page, plot, side == 0 ? before : after);
      }
    }
  };
  return figure;
}

}  // namespace cli
