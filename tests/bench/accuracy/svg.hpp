// A picture of lines, marks and words that is written as SVG. Colours are classes, so that one file is right on light
// and on dark paper.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bench {

enum class Mark { circle, square, triangle, diamond };

class Svg {
 public:
  // `style`: rules of CSS for the classes that are named below.
  Svg(double width, double height, const std::string &style);
  void line(double x0, double y0, double x1, double y1, const std::string &style);
  void path(const std::vector<std::pair<double, double>> &points, const std::string &style);
  void mark(Mark shape, double x, double y, const std::string &style);
  // anchor: "start", "middle" or "end".
  void words(double x, double y, const std::string &anchor, const std::string &style, const std::string &text);
  // Turned to be read from below.
  void words_upwards(double x, double y, const std::string &style, const std::string &text);
  // Throws std::runtime_error.
  void save(const std::string &path) const;

 private:
  std::string body_;
};

}  // namespace bench
