#include "canvas.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cli {
namespace {

constexpr int kDotsPerInch = 72;  // so that sizes of letters are pixels
constexpr int kTickSize = 15, kTitleSize = 16;
constexpr double kLeastGap = 72;  // between the ticks of a colour bar

void set_up(vtkTextProperty &style, const Colour &ink, int size, bool bold) {
  style.SetFontFamilyToArial();
  style.SetFontSize(size);
  style.SetBold(bold);
  style.SetItalic(0);
  style.SetShadow(0);
  style.SetColor(ink.red, ink.green, ink.blue);
}

// The share of a pixel's width or height that lies between two places.
double covered(int pixel, double from, double to) {
  return std::clamp(std::min(to, pixel + 1.0) - std::max(from, double(pixel)), 0.0, 1.0);
}

}  // namespace

Theme light_theme() { return {{1, 1, 1}, {0.12, 0.13, 0.15}, {0.78, 0.79, 0.81}}; }
Theme dark_theme() { return {{0.09, 0.10, 0.12}, {0.90, 0.91, 0.92}, {0.35, 0.37, 0.40}}; }

Canvas::Canvas(int width, int height, const Theme &theme) : image_(width, height), theme_(theme) {
  rectangle(0, 0, width, height, theme.paper);
}

void Canvas::rectangle(double x, double y, double width, double height, const Colour &colour, double opacity) {
  const int left = std::max(0, int(std::floor(x))), top = std::max(0, int(std::floor(y)));
  const int right = std::min(image_.width, int(std::ceil(x + width)));
  const int bottom = std::min(image_.height, int(std::ceil(y + height)));
  for (int j = top; j < bottom; j++) {
    for (int i = left; i < right; i++)
      blend(image_.pixel(i, j), colour, opacity * covered(i, x, x + width) * covered(j, y, y + height));
  }
}

void Canvas::line(double x0, double y0, double x1, double y1, double thickness, const Colour &colour) {
  const double length = std::hypot(x1 - x0, y1 - y0), half = thickness / 2;
  const auto clipped = [](double x, int size) { return std::clamp(int(std::floor(x)), 0, size); };
  const int left = clipped(std::min(x0, x1) - half - 1, image_.width),
            right = clipped(std::max(x0, x1) + half + 2, image_.width);
  const int top = clipped(std::min(y0, y1) - half - 1, image_.height),
            low = clipped(std::max(y0, y1) + half + 2, image_.height);
  for (int j = top; j < low; j++) {
    for (int i = left; i < right; i++) {
      const double px = i + 0.5 - x0, py = j + 0.5 - y0;
      const double along = length > 0 ? std::clamp((px * (x1 - x0) + py * (y1 - y0)) / length, 0.0, length) : 0;
      const double away = length > 0 ? std::hypot(px - along * (x1 - x0) / length, py - along * (y1 - y0) / length)
                                     : std::hypot(px, py);
      blend(image_.pixel(i, j), colour, std::clamp(half + 0.5 - away, 0.0, 1.0));
    }
  }
}

void Canvas::picture(const Image &image, int x, int y) {
  for (int j = std::max(0, -y); j < image.height && y + j < image_.height; j++) {
    for (int i = std::max(0, -x); i < image.width && x + i < image_.width; i++) {
      const std::uint8_t *from = image.pixel(i, j);
      blend(image_.pixel(x + i, y + j), {from[0] / 255.0, from[1] / 255.0, from[2] / 255.0}, from[3] / 255.0);
    }
  }
}

// FreeType alone: VTK's other way to letters starts a Python for words with $ in them.
void Canvas::text(const std::string &words, double x, double y, int size, Align align, bool bold) {
  vtkTextRenderer *letters = vtkTextRenderer::GetInstance();
  if (words.empty() || letters == nullptr) return;
  vtkNew<vtkTextProperty> style;
  vtkNew<vtkImageData> drawn;
  int extent[2] = {0, 0};
  set_up(*style, theme_.ink, size, bold);
  letters->SetScaleToPowerOfTwo(false);
  if (!letters->RenderString(style, vtkStdString(words), drawn, extent, kDotsPerInch, vtkTextRenderer::FreeType))
    return;
  const int *dimensions = drawn->GetDimensions();
  Image image(std::min(extent[0], dimensions[0]), std::min(extent[1], dimensions[1]));
  for (int j = 0; j < image.height; j++) {
    for (int i = 0; i < image.width; i++)
      std::copy_n(static_cast<std::uint8_t *>(drawn->GetScalarPointer(i, image.height - 1 - j, 0)), 4,
                  image.pixel(i, j));
  }
  const double shift = align == Align::left ? 0 : align == Align::centre ? 0.5 : 1;
  picture(image, int(std::lround(x - shift * image.width)), int(std::lround(y - 0.5 * image.height)));
}

void Canvas::colour_bar(int x, int y, int width, const Scale &scale, const std::function<Colour(double)> &map,
                        const std::string &title) {
  constexpr int height = 16;
  text(title, x - 14, y + height / 2, kTitleSize, Align::right);
  for (int i = 0; i < width; i++) rectangle(x + i, y, 1, height, map((i + 0.5) / width));
  for (const double tick : with_ends(scale, kLeastGap / width)) {
    const double at = x + width * scale.share(tick);
    rectangle(at - 0.5, y + height, 1, 5, theme_.ink);
    text(number_text(tick, scale), at, y + height + 15, kTickSize, Align::centre);
  }
}

}  // namespace cli
