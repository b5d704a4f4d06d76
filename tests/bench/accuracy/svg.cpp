#include "svg.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace bench {
namespace {

constexpr double kMarkRadius = 4;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string escaped(const std::string &text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string corners(const std::vector<std::pair<double, double>> &points) {
  std::string list;
  for (const auto &[x, y] : points) list += (list.empty() ? "" : " ") + number(x) + "," + number(y);
  return list;
}

std::vector<std::pair<double, double>> outline(Mark shape, double x, double y) {
  const double r = kMarkRadius;
  switch (shape) {
    case Mark::square: return {{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}};
    case Mark::triangle: return {{x, y - 1.3 * r}, {x + 1.2 * r, y + 0.9 * r}, {x - 1.2 * r, y + 0.9 * r}};
    default: return {{x, y - 1.4 * r}, {x + 1.4 * r, y}, {x, y + 1.4 * r}, {x - 1.4 * r, y}};
  }
}

}  // namespace

Svg::Svg(double width, double height, const std::string &style)
    : body_("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
            "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\">\n<style>\n" + style +
            "</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n") {}

void Svg::line(double x0, double y0, double x1, double y1, const std::string &style) {
  body_ += "<line class=\"" + style + "\" x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
           "\" y2=\"" + number(y1) + "\"/>\n";
}

void Svg::path(const std::vector<std::pair<double, double>> &points, const std::string &style) {
  body_ += "<polyline class=\"" + style + "\" points=\"" + corners(points) + "\"/>\n";
}

void Svg::mark(Mark shape, double x, double y, const std::string &style) {
  if (shape == Mark::circle) {
    body_ += "<circle class=\"" + style + "\" cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" +
             number(kMarkRadius) + "\"/>\n";
  } else {
    body_ += "<polygon class=\"" + style + "\" points=\"" + corners(outline(shape, x, y)) + "\"/>\n";
  }
}

void Svg::words(double x, double y, const std::string &anchor, const std::string &style, const std::string &text) {
  body_ += "<text class=\"" + style + "\" x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor +
           "\">" + escaped(text) + "</text>\n";
}

void Svg::words_upwards(double x, double y, const std::string &style, const std::string &text) {
  body_ += "<text class=\"" + style + "\" text-anchor=\"middle\" transform=\"translate(" + number(x) + " " + number(y) +
           ") rotate(-90)\">" + escaped(text) + "</text>\n";
}

void Svg::save(const std::string &path) const {
  std::ofstream file(path);
  file << body_ << "</svg>\n";
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace bench
