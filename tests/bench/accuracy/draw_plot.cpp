#include "draw_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "svg.hpp"

namespace bench {
namespace {

// Methods differ in colour, in dashes and in marks. The colours are of the set of Okabe and Ito, which most kinds of
// colour blindness tell apart; on dark paper lighter ones.
struct Look {
  const char *method, *label;
  Mark mark;
};

constexpr Look kLooks[] = {{"peer", "VTK's edge collapse", Mark::circle},
                           {"accurate", "tetlod, accurate", Mark::diamond},
                           {"fast", "tetlod, fast", Mark::square},
                           {"paper", "tetlod, paper", Mark::triangle}};

constexpr const char *kStyle =
    "text { font: 13px sans-serif; fill: #222; } .title { font-weight: bold; }\n"
    ".paper { fill: #fff; } .grid { stroke: #ddd; } .frame { stroke: #888; }\n"
    "polyline { stroke-width: 2; } circle, polygon { stroke: #fff; stroke-width: 1; }\n"
    "polyline.peer { stroke: #000; stroke-dasharray: 6 4; } .peer { fill: #000; }\n"
    "polyline.accurate { stroke: #0072b2; } .accurate { fill: #0072b2; }\n"
    "polyline.fast { stroke: #d55e00; } .fast { fill: #d55e00; }\n"
    "polyline.paper-preset { stroke: #009e73; stroke-dasharray: 2 3; } .paper-preset { fill: #009e73; }\n"
    "polyline { fill: none !important; }\n"  // whatever its marks are filled with
    "@media (prefers-color-scheme: dark) {\n"
    "text { fill: #e6e6e6; } .paper { fill: #14171c; } .grid { stroke: #333a44; } .frame { stroke: #777; }\n"
    "circle, polygon { stroke: #14171c; } polyline.peer { stroke: #f2f2f2; } .peer { fill: #f2f2f2; }\n"
    "polyline.accurate { stroke: #56b4e9; } .accurate { fill: #56b4e9; }\n"
    "polyline.fast { stroke: #e69f00; } .fast { fill: #e69f00; }\n"
    "polyline.paper-preset { stroke: #00c896; } .paper-preset { fill: #00c896; }\n"
    "}\n";

constexpr double kPanelWidth = 330, kPanelHeight = 270, kLeft = 62, kRight = 14, kTop = 34, kBottom = 46, kLegend = 34;
constexpr std::size_t kColumns = 3;

std::string style_of(const Look &look) {
  return std::string(look.method) == "paper" ? "paper-preset" : look.method;  // .paper is what is drawn on
}

// A logarithmic axis from one decade's 1, 2 or 5 to another's.
class Axis {
 public:
  Axis(double least, double most, double begin, double end) : begin_(begin), end_(end) {
    low_ = round_down(least * kSlack);
    high_ = low_;
    while (high_ < most / kSlack) high_ = next(high_);
    if (high_ == low_) high_ = next(high_);
  }
  double at(double value) const { return begin_ + (end_ - begin_) * std::log(value / low_) / std::log(high_ / low_); }
  std::vector<double> ticks() const {
    std::vector<double> all;
    for (double tick = low_; tick <= high_ * (1 + 1e-9); tick = next(tick)) all.push_back(tick);
    return all;
  }

 private:
  static constexpr double kSlack = 1.03;  // so far beyond an end a mark is still read

  static double decade(double value) { return std::pow(10.0, std::floor(std::log10(value) + 1e-9)); }
  static double round_down(double value) {
    const double unit = decade(value), lead = value / unit;
    return unit * (lead >= 5 - 1e-9 ? 5 : lead >= 2 - 1e-9 ? 2 : 1);
  }
  static double next(double tick) {
    const double unit = decade(tick), lead = std::round(tick / unit);
    return unit * (lead < 2 ? 2 : lead < 5 ? 5 : 10);
  }

  double begin_, end_, low_, high_;
};

struct Dot {
  double kept, rms;  // percent
};

std::vector<Dot> dots_of(const Sweep &sweep, const std::string &method) {
  std::vector<Dot> dots;
  for (const SizeRow &row : sweep.rows) {
    for (const Entry &entry : row.entries) {
      if (entry.method != method || !(entry.quality.field.rms > 0)) continue;
      dots.push_back({100 * double(entry.tets) / double(sweep.tets), 100 * entry.quality.field.rms});
    }
  }
  std::sort(dots.begin(), dots.end(), [](const Dot &a, const Dot &b) { return a.kept < b.kept; });
  return dots;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

std::string tick_label(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void draw_axes(Svg &svg, const Axis &x, const Axis &y, double left, double right, double top, double bottom) {
  for (const double tick : x.ticks()) {
    svg.line(x.at(tick), top, x.at(tick), bottom, "grid");
    svg.words(x.at(tick), bottom + 16, "middle", "tick", tick_label(tick));
  }
  for (const double tick : y.ticks()) {
    svg.line(left, y.at(tick), right, y.at(tick), "grid");
    svg.words(left - 6, y.at(tick) + 4, "end", "tick", tick_label(tick));
  }
  svg.line(left, bottom, right, bottom, "frame");
  svg.line(left, top, left, bottom, "frame");
}

void draw_method(Svg &svg, const Look &look, const std::vector<Dot> &dots, const Axis &x, const Axis &y) {
  std::vector<std::pair<double, double>> points;
  for (const Dot &dot : dots) points.emplace_back(x.at(dot.kept), y.at(dot.rms));
  svg.path(points, style_of(look));
  for (const auto &[px, py] : points) svg.mark(look.mark, px, py, style_of(look));
}

void draw_panel(Svg &svg, const Sweep &sweep, double x0, double y0) {
  Extent kept, rms;
  for (const Look &look : kLooks) {
    for (const Dot &dot : dots_of(sweep, look.method)) {
      kept.add(dot.kept);
      rms.add(dot.rms);
    }
  }
  if (!(kept.most > 0)) return;
  const double left = x0 + kLeft, right = x0 + kPanelWidth - kRight;
  const double top = y0 + kTop, bottom = y0 + kPanelHeight - kBottom;
  const Axis x(kept.least, kept.most, left, right), y(rms.least, rms.most, bottom, top);
  svg.words(0.5 * (left + right), top - 12, "middle", "title", sweep.set);
  draw_axes(svg, x, y, left, right, top, bottom);
  svg.words(0.5 * (left + right), bottom + 36, "middle", "label", "tets kept, %");
  svg.words_upwards(x0 + 16, 0.5 * (top + bottom), "label", "RMS, % of range");
  for (const Look &look : kLooks) draw_method(svg, look, dots_of(sweep, look.method), x, y);
}

void draw_legend(Svg &svg) {
  double x = kLeft;
  for (const Look &look : kLooks) {
    svg.path({{x, 20}, {x + 36, 20}}, style_of(look));
    svg.mark(look.mark, x + 18, 20, style_of(look));
    svg.words(x + 44, 24, "start", "label", look.label);
    x += 210;
  }
}

}  // namespace

void draw_plot(const std::string &path, const std::vector<Sweep> &sweeps) {
  const std::size_t rows = (sweeps.size() + kColumns - 1) / kColumns;
  Svg svg(double(kColumns) * kPanelWidth, kLegend + double(rows) * kPanelHeight, kStyle);
  draw_legend(svg);
  for (std::size_t i = 0; i < sweeps.size(); i++) {
    draw_panel(svg, sweeps[i], double(i % kColumns) * kPanelWidth, kLegend + double(i / kColumns) * kPanelHeight);
  }
  svg.save(path);
}

}  // namespace bench
