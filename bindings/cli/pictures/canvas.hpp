// A page that pictures, lines and words are put on. Places are in pixels from the top left corner.
#pragma once

#include <functional>
#include <string>

#include "image.hpp"
#include "scale.hpp"

namespace cli {

struct Theme {
  Colour paper, ink, faint;  // ground, words, lines beside them
};

Theme light_theme();
Theme dark_theme();

enum class Align { left, centre, right };

class Canvas {
 public:
  Canvas(int width, int height, const Theme &theme);

  void rectangle(double x, double y, double width, double height, const Colour &colour, double opacity = 1);
  void line(double x0, double y0, double x1, double y1, double thickness, const Colour &colour);
  // The middle of the words' first line at y.
  void text(const std::string &words, double x, double y, int size, Align align = Align::left, bool bold = false);
  void picture(const Image &image, int x, int y);
  // A bar of colours with its ticks below and a title before it; 60 pixels high.
  void colour_bar(int x, int y, int width, const Scale &scale, const std::function<Colour(double)> &map,
                  const std::string &title);

  const Theme &theme() const { return theme_; }
  const Image &image() const { return image_; }

 private:
  Image image_;
  Theme theme_;
};

}  // namespace cli
