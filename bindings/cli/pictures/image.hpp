// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct Colour {
  double red, green, blue;  // 0 to 1
};

inline Colour mixed(const Colour &a, const Colour &b, double share_of_b) {
  const double s = share_of_b, r = 1 - s;
  return {r * a.red + s * b.red, r * a.green + s * b.green, r * a.blue + s * b.blue};
}

// Rows from the top; 4 bytes a pixel: red, green, blue, opacity, the colours not multiplied by it.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(std::size_t(w) * std::size_t(h) * 4, 0) {}
  std::uint8_t *pixel(int x, int y) { return rgba.data() + 4 * (std::size_t(y) * std::size_t(width) + std::size_t(x)); }
  const std::uint8_t *pixel(int x, int y) const { return const_cast<Image *>(this)->pixel(x, y); }
};

// Lays a colour over a pixel.
void blend(std::uint8_t *pixel, const Colour &colour, double opacity);

// The bytes of a PNG file, without the opacity.
std::string png_of(const Image &image);

}  // namespace cli
