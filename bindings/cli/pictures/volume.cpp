#include "volume.hpp"

#include <vtkCellArray.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "colour_map.hpp"
#include "interrupt.hpp"

namespace cli {
namespace {

constexpr double kMeanDepth = 0.8;  // e-foldings that a ray meets in the original on average
constexpr double kFlattening = 0.06;

// A sample is in one pixel's thin layer and beside the next one's: the grain of that is smoothed away, over 3 x 3
// pixels.
Image smoothed(const Image &image) {
  constexpr int weight[3] = {1, 2, 1};
  Image out(image.width, image.height);
  for (int y = 1; y + 1 < image.height; y++) {
    for (int x = 1; x + 1 < image.width; x++) {
      int sum[4] = {0, 0, 0, 0};
      for (int k = 0; k < 9; k++) {
        const std::uint8_t *pixel = image.pixel(x + k % 3 - 1, y + k / 3 - 1);
        const int opaque = weight[k % 3] * weight[k / 3] * pixel[3];
        for (int c = 0; c < 3; c++) sum[c] += opaque * pixel[c];
        sum[3] += opaque;
      }
      if (sum[3] == 0) continue;
      for (int c = 0; c < 3; c++) out.pixel(x, y)[c] = static_cast<std::uint8_t>(sum[c] / sum[3]);
      out.pixel(x, y)[3] = static_cast<std::uint8_t>(sum[3] / 16);
    }
  }
  return out;
}

double determinant(const Vector &a, const Vector &b, const Vector &c) { return dot(a, cross(b, c)); }
Vector minus(const Vector &a, const Vector &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

Volume::Volume(const View &view, const std::vector<Vector> &points, int depths, const Scale &scale)
    : view_(view),
      depths_(depths),
      scale_(scale),
      shares_(std::size_t(view.width) * std::size_t(view.height) * std::size_t(depths),
              std::numeric_limits<float>::quiet_NaN()) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector &p : points) low = std::min(low, dot(p, view.toward)), high = std::max(high, dot(p, view.toward));
  far_ = low;
  step_ = std::max((high - low) / depths, std::numeric_limits<double>::min());
}

// Corners in samples: columns, rows, depths from the far end; samples lie in the middle of unit cubes.
void Volume::fill_tet(const Vector corner[4], const double value[4]) {
  const Vector u = minus(corner[1], corner[0]), v = minus(corner[2], corner[0]), w = minus(corner[3], corner[0]);
  const double whole = determinant(u, v, w);
  if (whole == 0 || !std::isfinite(whole)) return;
  const int size[3] = {view_.width, view_.height, depths_};
  int from[3], to[3];
  for (std::size_t k = 0; k < 3; k++) {
    const auto [low, high] = std::minmax({corner[0][k], corner[1][k], corner[2][k], corner[3][k]});
    from[k] = std::max(0, int(std::ceil(low - 0.5)));
    to[k] = std::min(size[k] - 1, int(std::floor(high - 0.5)));
  }
  from[2] = std::max(0, from[2] - 1);  // a sample may be anywhere in its part
  to[2] = std::min(depths_ - 1, to[2] + 1);
  const Vector along_u = cross(v, w), along_v = cross(w, u), along_w = cross(u, v);
  for (int y = from[1]; y <= to[1]; y++) {
    for (int x = from[0]; x <= to[0]; x++) {
      for (int z = from[2]; z <= to[2]; z++) {
        const Vector p = minus({x + 0.5, y + 0.5, z + place(x, y)}, corner[0]);
        const double a = dot(p, along_u) / whole, b = dot(p, along_v) / whole, c = dot(p, along_w) / whole;
        if (a < 0 || b < 0 || c < 0 || a + b + c > 1) continue;
        const double here = (1 - a - b - c) * value[0] + a * value[1] + b * value[2] + c * value[3];
        at(x, y, z) = static_cast<float>(scale_.share(here));
      }
    }
  }
}

double Volume::place(int x, int y) {
  std::uint32_t bits = static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U;
  bits = (bits ^ bits >> 15) * 2246822519U;
  bits = (bits ^ bits >> 13) * 3266489917U;
  return double(bits >> 8) / double(1U << 24);
}

void Volume::fill(const Sight &sight) {
  vtkIdType size = 0;
  const vtkIdType *ids = nullptr;
  for (vtkIdType c = 0; c < sight.grid->GetNumberOfCells(); c++) {
    stop_if_interrupted();
    sight.grid->GetCells()->GetCellAtId(c, size, ids);
    if (size != 4) continue;
    Vector corner[4];
    double value[4];
    for (int k = 0; k < 4; k++) {
      Vector p{};
      sight.grid->GetPoint(ids[k], p.data());
      corner[k] = view_.project(p);
      corner[k][2] = (corner[k][2] - far_) / step_;
      value[k] = sight.values->GetTuple1(ids[k]);
    }
    fill_tet(corner, value);
  }
}

double Volume::mean_part() const {
  std::size_t inside = 0, rays = 0;
  for (auto ray = shares_.begin(); ray != shares_.end(); ray += depths_) {
    const auto samples = std::size_t(std::count_if(ray, ray + depths_, [](float v) { return std::isfinite(v); }));
    inside += samples;
    rays += samples > 0 ? 1 : 0;
  }
  return rays > 0 ? double(inside) / double(rays) / depths_ : 1;
}

Image Volume::image(const std::vector<double> &opacity) const {
  Image image(view_.width, view_.height);
  const double bins = double(opacity.size());
  for (int y = 0; y < view_.height; y++) {
    stop_if_interrupted();
    for (int x = 0; x < view_.width; x++) {
      const float *ray =
          shares_.data() + (std::size_t(y) * std::size_t(view_.width) + std::size_t(x)) * std::size_t(depths_);
      double clear = 1, sum[3] = {0, 0, 0};
      for (int z = depths_ - 1; z >= 0 && clear > 0.005; z--) {
        if (!std::isfinite(ray[z])) continue;
        const double share = double(ray[z]);
        const double dense = opacity[std::min(std::size_t(share * bins), opacity.size() - 1)];
        const double part = clear * (1 - std::exp(-dense / depths_));
        const Colour colour = field_colour(share);
        sum[0] += part * colour.red, sum[1] += part * colour.green, sum[2] += part * colour.blue;
        clear -= part;
      }
      if (clear < 1)
        blend(image.pixel(x, y), {sum[0] / (1 - clear), sum[1] / (1 - clear), sum[2] / (1 - clear)}, 1 - clear);
    }
  }
  return smoothed(image);
}

std::vector<double> opacity_by_rarity(const Volume &volume, int bins) {
  std::vector<double> counts(std::size_t(bins), 0), opacity;
  double whole = 0, mean = 0;
  for (const float share : volume.shares()) {
    if (!std::isfinite(share)) continue;
    counts[std::min(std::size_t(double(share) * bins), counts.size() - 1)]++;
    whole++;
  }
  for (const double count : counts) {
    const double crowd = whole > 0 ? bins * count / whole : 0;  // 1: as common as all others
    opacity.push_back(1 / (crowd + kFlattening));
    mean += whole > 0 ? opacity.back() * count / whole : 0;
  }
  for (double &o : opacity) o = mean > 0 ? kMeanDepth * o / mean / volume.mean_part() : 0;
  return opacity;
}

}  // namespace cli
