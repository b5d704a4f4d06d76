// Slices of both meshes with the difference under them.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "colour_map.hpp"
#include "figure.hpp"
#include "raster.hpp"

namespace cli {
namespace {

constexpr int kSamples = 2, kWidth = 480, kHeight = 300, kHead = 40, kFoot = 60;
constexpr double kUsualPart = 0.995;  // of the differences are within the error's scale

// One plane, seen from the same place in both meshes.
struct Slice {
  int axis;
  double at;
  View view;
  Raster original, simplified;
};

double low_of(const Pair &pair, int axis) { return pair.original.grid->GetBounds()[2 * axis]; }
double high_of(const Pair &pair, int axis) { return pair.original.grid->GetBounds()[2 * axis + 1]; }

Raster drawn(const Shape &shape, const View &view) {
  Raster raster(view.width, view.height, kSamples);
  raster.draw_triangles(shape, view, false);
  raster.draw_edges(shape, view);
  return raster;
}

// Both slices fill the picture.
Slice cut(const Pair &pair, int axis, double at) {
  const Vector extent{high_of(pair, 0) - low_of(pair, 0), high_of(pair, 1) - low_of(pair, 1),
                      high_of(pair, 2) - low_of(pair, 2)};
  View view = view_along(axis, extent);
  const Shape original = slice_of(pair.original, axis, at), simplified = slice_of(pair.simplified, axis, at);
  std::vector<Vector> points = original.points;
  points.insert(points.end(), simplified.points.begin(), simplified.points.end());
  fit(view, points, kWidth, kHeight);
  return {axis, at, view, drawn(original, view), drawn(simplified, view)};
}

// The difference of two samples as a part of the field's range; NaN where only one of them is covered.
double difference(const Raster::Sample &a, const Raster::Sample &b, double range) {
  if (!a.covered() || !b.covered()) return std::nan("");
  return std::abs(double(a.value) - double(b.value)) / (range > 0 ? range : 1);
}

// Adds places to a sum, each by its squared error.
struct ErrorCentre {
  Vector sum{};
  Vector weight{};

  void add(const Slice &slice, double range) {
    const View &view = slice.view;
    for (std::size_t i = 0; i < slice.original.samples().size(); i++) {
      const double e = difference(slice.original.samples()[i], slice.simplified.samples()[i], range);
      if (!std::isfinite(e)) continue;
      const int columns = view.width * kSamples, x = int(i) % columns, y = int(i) / columns;
      const double along = ((x + 0.5) / kSamples - 0.5 * view.width) / view.pixels + view.centre_x;
      const double up = (0.5 * view.height - (y + 0.5) / kSamples) / view.pixels + view.centre_y;
      for (std::size_t k = 0; k < 3; k++) {
        if (int(k) == slice.axis) continue;
        sum[k] += e * e * (along * view.right[k] + up * view.up[k]);
        weight[k] += e * e;
      }
    }
  }
};

// One an axis: through the middle first, then through the centre of the squared errors that show there.
std::vector<Slice> slices_of(const Pair &pair) {
  ErrorCentre centre;
  Vector middle{};
  for (int axis = 0; axis < 3; axis++) {
    middle[std::size_t(axis)] = 0.5 * (low_of(pair, axis) + high_of(pair, axis));
    centre.add(cut(pair, axis, middle[std::size_t(axis)]), pair.range);
  }
  std::vector<Slice> slices;
  for (int axis = 0; axis < 3; axis++) {
    const auto k = std::size_t(axis);
    slices.push_back(cut(pair, axis, centre.weight[k] > 0 ? centre.sum[k] / centre.weight[k] : middle[k]));
  }
  return slices;
}

Scale error_scale(const std::vector<Slice> &slices, double range) {
  std::vector<double> errors;
  for (const Slice &slice : slices) {
    for (std::size_t i = 0; i < slice.original.samples().size(); i++) {
      const double e = difference(slice.original.samples()[i], slice.simplified.samples()[i], range);
      if (std::isfinite(e)) errors.push_back(100 * e);
    }
  }
  if (errors.empty()) return {0, 1, false};
  const auto usual = errors.begin() + std::ptrdiff_t(kUsualPart * double(errors.size() - 1));
  std::nth_element(errors.begin(), usual, errors.end());
  return {0, *usual > 0 ? *usual : 1e-9, false};
}

Image field_image(const Raster &raster, const Scale &scale) {
  return raster.image([&](const Raster::Sample &s) {
    return std::isfinite(s.value) ? field_colour(scale.share(double(s.value))) : no_colour();
  });
}

// Where only one of the two has a value, the sample's is NaN, which has a colour of its own.
Image error_image(const Slice &slice, double range, const Scale &scale) {
  Raster errors = slice.original;
  for (std::size_t i = 0; i < errors.samples().size(); i++) {
    Raster::Sample &sample = errors.samples()[i];
    const Raster::Sample &other = slice.simplified.samples()[i];
    sample.value = 100 * difference(sample, other, range);
    sample.depth = std::max(sample.depth, other.depth);
    sample.ink = 0;
    sample.light = 1;
  }
  return errors.image([&](const Raster::Sample &s) {
    return std::isfinite(s.value) ? error_colour(scale.share(double(s.value))) : no_colour();
  });
}

// ", y right, z up"
std::string directions_of(const View &view) {
  const auto name = [](const Vector &v) { return "xyz"[std::max_element(v.begin(), v.end()) - v.begin()]; };
  return std::string(", ") + name(view.right) + " right, " + name(view.up) + " up";
}

struct Pictures {
  std::array<std::array<Image, 3>, 3> rows;  // original, simplified, difference; by axis
  std::array<std::string, 3> places, directions;
  Scale errors;
};

std::shared_ptr<Pictures> pictures_of(const Pair &pair) {
  const std::vector<Slice> slices = slices_of(pair);
  auto made = std::make_shared<Pictures>();
  made->errors = error_scale(slices, pair.range);
  for (const Slice &slice : slices) {
    const auto k = std::size_t(slice.axis);
    made->rows[0][k] = field_image(slice.original, pair.scale);
    made->rows[1][k] = field_image(slice.simplified, pair.scale);
    made->rows[2][k] = error_image(slice, pair.range, made->errors);
    made->places[k] = std::string(1, "xyz"[k]) + " = " + number_text(slice.at);
    made->directions[k] = directions_of(slice.view);
  }
  return made;
}

}  // namespace

Figure slice_figure(const Pair &pair) {
  const auto pictures = pictures_of(pair);
  Figure figure{"slices", "Slices and the error", "", kPageWidth, 3 * (kHead + kHeight) + 2 * kFoot, {}};
  figure.caption =
      "Planes through the centre of the error, one for each axis: both meshes, and the difference of their fields as a "
      "part "
      "of the field's range. The scale ends where 0.5 % of the differences are beyond it. Blue: inside of one of the "
      "two "
      "meshes only, or without a value.";
  figure.draw = [pictures, pair](Canvas &page) {
    const std::string titles[] = {pair.captions[0], pair.captions[1], "difference"};
    int top = 0;
    for (std::size_t row = 0; row < 3; row++) {
      page.text(titles[row], 10, top + kHead / 2.0, kCaptionSize, Align::left, true);
      for (std::size_t k = 0; k < 3; k++) {
        const int left = int(k) * (kPageWidth - kWidth) / 2;
        page.text(pictures->places[k] + (row == 0 ? pictures->directions[k] : ""), left + kWidth - 10,
                  top + kHead / 2.0, 16, Align::right);
        page.picture(pictures->rows[row][k], left, top + kHead);
      }
      top += kHead + kHeight;
      if (row == 1) {
        page.colour_bar(kBarLeft, top + 14, kBarWidth, pair.scale, field_colour, pair.axis);
        top += kFoot;
      }
    }
    page.colour_bar(kBarLeft, top + 14, kBarWidth, pictures->errors, error_colour, "difference, % of the range");
    draw_no_colour(page, "in one mesh only", top + 14);
  };
  return figure;
}

}  // namespace cli
