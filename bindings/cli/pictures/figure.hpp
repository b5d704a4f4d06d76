// The pictures of a report: each can be drawn on light and on dark paper.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "canvas.hpp"
#include "shape.hpp"
#include "tetlod.h"
#include "view.hpp"

namespace cli {

// What is compared.
struct Pair {
  Sight original, simplified;
  std::string label;  // of the field, with its unit; long names are shortened
  Scale scale;        // of the original's finite values
  std::string axis;   // the label, and what is to be said of the scale
  double range;       // of the original's finite values
  bool whole;         // all values of the original are finite
  std::string captions[2];
};

// "heat [K]"
std::string label_of(vtkDataArray &values, const std::string &name);

Pair pair_of(vtkUnstructuredGrid *original, vtkUnstructuredGrid *simplified, const std::string &field,
             const tetlod_run_report &run);

struct Figure {
  std::string name, title, caption;  // name: of the file, without its ending
  int width, height;
  std::function<void(Canvas &)> draw;
};

Figure surface_figure(const Pair &pair, const View &view);
Figure isosurface_figure(const Pair &pair, const View &view);
Figure volume_figure(const Pair &pair, const View &view);
Figure slice_figure(const Pair &pair);
Figure histogram_figure(const Pair &pair);

// The view that the first three share.
View view_of(const Pair &pair);

// Tells what the colour of nothing means, right of a colour bar at that height.
void draw_no_colour(Canvas &page, const std::string &meaning, int y);

// A pale shadow of a surface, to see where in the mesh something is.
Image shadow_of(const Shape &surface, const View &view);

// How often the finite values of an array are in each of `bins` equal parts of the scale.
std::vector<long long> histogram_of(vtkDataArray &values, const Scale &scale, int bins);
// Values whose isosurfaces say the most: at quarters of the histogram, in which common values weigh by their logarithm.
std::vector<double> iso_values(const Pair &pair);

// How pages are laid out, in pixels.
constexpr int kBarLeft = 530, kBarWidth = 600;
constexpr int kPanelWidth = 720, kPageWidth = 1480, kGap = 20, kCaptionSize = 18;

}  // namespace cli
