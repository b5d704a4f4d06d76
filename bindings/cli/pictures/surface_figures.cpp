// Surfaces: the boundary with its edges, and isosurfaces [4, Figure 6].
#include <array>
#include <cmath>
#include <memory>

#include "colour_map.hpp"
#include "figure.hpp"
#include "raster.hpp"

namespace cli {
namespace {

constexpr int kSamples = 3, kSurfaceHeight = 460, kIsoHeight = 340, kHead = 40, kFoot = 60;

int panel_left(int side) { return side == 0 ? 0 : kPageWidth - kPanelWidth; }

void draw_captions(Canvas &page, const Pair &pair) {
  for (int side = 0; side < 2; side++)
    page.text(pair.captions[side], panel_left(side) + kPanelWidth / 2, kHead / 2, kCaptionSize, Align::centre, true);
}

void draw_colour_bar(Canvas &page, const Pair &pair, int y) {
  page.colour_bar(kBarLeft, y, kBarWidth, pair.scale, field_colour, pair.axis);
}

// Which way the axes go.
void draw_axes(Canvas &page, const View &view, double x, double y) {
  constexpr double length = 34;
  const char *names[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; k++) {
    const double right = length * view.right[k], up = length * view.up[k];
    page.line(x, y, x + right, y - up, 2, page.theme().ink);
    page.text(names[k], x + 1.35 * right, y - 1.35 * up, 14, Align::centre);
  }
}

Image surface_panel(const Pair &pair, const Sight &sight, const View &view) {
  const Shape surface = surface_of(sight);
  Raster raster(view.width, view.height, kSamples);
  raster.draw_triangles(surface, view);
  raster.draw_edges(surface, view);
  return raster.image([&](const Raster::Sample &s) { return field_colour(pair.scale.share(double(s.value))); });
}

struct IsoPanel {
  Image image;
  std::size_t triangles;
};

IsoPanel iso_panel(const Pair &pair, const Sight &sight, const View &view, double value) {
  const Shape shape = isosurface_of(sight, value);
  Raster raster(view.width, view.height, kSamples);
  raster.draw_triangles(shape, view);
  const Colour colour = field_colour(0.15 + 0.7 * pair.scale.share(value));
  return {raster.image([&](const Raster::Sample &) { return colour; }), shape.triangles.size()};
}

// The edges of the box around the original.
void draw_box(Canvas &page, const Pair &pair, const View &view, int left, int top) {
  double bounds[6];
  pair.original.grid->GetBounds(bounds);
  const auto corner = [&](int c) {
    return view.project({bounds[c & 1], bounds[2 + (c >> 1 & 1)], bounds[4 + (c >> 2 & 1)]});
  };
  for (int from = 0; from < 8; from++) {
    for (const int bit : {1, 2, 4}) {
      if (from & bit) continue;
      const Vector p = corner(from), q = corner(from | bit);
      page.line(left + p[0], top + p[1], left + q[0], top + q[1], 1, page.theme().faint);
    }
  }
}

std::vector<Vector> box_points(const Pair &pair) {
  double b[6];
  pair.original.grid->GetBounds(b);
  std::vector<Vector> points;
  for (int c = 0; c < 8; c++) points.push_back({b[c & 1], b[2 + (c >> 1 & 1)], b[4 + (c >> 2 & 1)]});
  return points;
}

}  // namespace

Figure surface_figure(const Pair &pair, const View &view) {
  const auto images = std::make_shared<std::array<Image, 2>>(
      std::array<Image, 2>{surface_panel(pair, pair.original, view), surface_panel(pair, pair.simplified, view)});
  Figure figure{"surface", "The surface", "", kPageWidth, kHead + kSurfaceHeight + kFoot, {}};
  figure.caption =
      "The boundary of both meshes with the edges of its triangles, coloured by the field: one camera, one colour map. "
      "Edges fade where they are too dense to be told apart.";
  figure.draw = [images, pair, view](Canvas &page) {
    draw_captions(page, pair);
    for (int side = 0; side < 2; side++) page.picture((*images)[std::size_t(side)], panel_left(side), kHead);
    draw_axes(page, view, kPageWidth / 2.0, kHead + kSurfaceHeight - 50);
    draw_colour_bar(page, pair, kHead + kSurfaceHeight + 12);
    if (!pair.whole) draw_no_colour(page, "without a value", kHead + kSurfaceHeight + 12);
  };
  return figure;
}

Figure isosurface_figure(const Pair &pair, const View &from) {
  struct Row {
    double value;
    IsoPanel sides[2];
  };
  View view = from;
  fit(view, box_points(pair), kPanelWidth, kIsoHeight);
  const auto shadows = std::make_shared<std::array<Image, 2>>(
      std::array<Image, 2>{shadow_of(surface_of(pair.original), view), shadow_of(surface_of(pair.simplified), view)});
  const auto rows = std::make_shared<std::vector<Row>>();
  for (const double value : iso_values(pair))
    rows->push_back(
        {value, {iso_panel(pair, pair.original, view, value), iso_panel(pair, pair.simplified, view, value)}});
  Figure figure{"isosurfaces", "Isosurfaces", "", kPageWidth, kHead + (kIsoHeight + kHead) * int(rows->size()), {}};
  figure.caption =
      "Where the field has a value, at three values from its histogram (the paper's Figure 6), in the shadow of the "
      "mesh. "
      "The thin lines are the box around the original.";
  figure.draw = [rows, shadows, pair, view](Canvas &page) {
    draw_captions(page, pair);
    int top = kHead;
    for (const Row &row : *rows) {
      page.text(pair.label + " = " + number_text(row.value, pair.scale), kPageWidth / 2.0, top + 12, 16, Align::centre);
      for (int side = 0; side < 2; side++) {
        const IsoPanel &panel = row.sides[side];
        page.picture((*shadows)[std::size_t(side)], panel_left(side), top + kHead / 2);
        draw_box(page, pair, view, panel_left(side), top + kHead / 2);
        page.picture(panel.image, panel_left(side), top + kHead / 2);
        const std::string size =
            panel.triangles > 0 ? count_text((long long)(panel.triangles)) + " triangles" : "not reached";
        page.text(size, panel_left(side) + kPanelWidth / 2, top + kHead / 2 + kIsoHeight + 2, 14, Align::centre);
      }
      top += kIsoHeight + kHead;
    }
  };
  return figure;
}

}  // namespace cli
