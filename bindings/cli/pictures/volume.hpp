// Looks through a mesh as through coloured smoke [4, Figure 9].
#pragma once

#include <cstddef>
#include <vector>

#include "image.hpp"
#include "scale.hpp"
#include "shape.hpp"
#include "view.hpp"

namespace cli {

// The field at points that lie in rows behind the pixels of a view.
class Volume {
 public:
  // The depths that are sampled are those of the points.
  Volume(const View &view, const std::vector<Vector> &points, int depths, const Scale &scale);

  // Tets alone: other cells must have been split.
  void fill(const Sight &sight);

  // Where in its part of the depth a pixel's samples are, 0 to 1: another place for each pixel, so that thin layers do
  // not show as stripes.
  static double place(int x, int y);

  // Where the field is on its scale: a value may be large beside its range. NaN outside of the mesh.
  const std::vector<float> &shares() const { return shares_; }
  // The part of the depth that is in the mesh, of the rays that meet it, in the mean.
  double mean_part() const;
  // From front to back; opacity of each part of the scale over the whole depth, in e-foldings.
  Image image(const std::vector<double> &opacity) const;

 private:
  void fill_tet(const Vector corner[4], const double value[4]);
  float &at(int x, int y, int depth) {
    return shares_[(std::size_t(y) * std::size_t(view_.width) + std::size_t(x)) * std::size_t(depths_) +
                   std::size_t(depth)];
  }

  View view_;
  double far_, step_;  // in units of length
  int depths_;
  Scale scale_;
  std::vector<float> shares_;
};

// For each of `bins` parts of the scale: the rarer its values in the volume, the denser.
std::vector<double> opacity_by_rarity(const Volume &volume, int bins);

}  // namespace cli
