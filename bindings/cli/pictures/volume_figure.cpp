// Both meshes as coloured smoke.
#include <vtkDataSetTriangleFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <array>
#include <memory>

#include "colour_map.hpp"
#include "figure.hpp"
#include "volume.hpp"

namespace cli {
namespace {

constexpr int kDepths = 192, kBins = 64, kHeight = 420, kHead = 40, kFoot = 60;

Sight in_tets(const Sight &sight) {
  if (sight.grid->GetCells()->IsHomogeneous() == 4) return sight;
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->TetrahedraOnlyOn();
  filter->SetInputData(sight.grid);
  filter->Update();
  return {filter->GetOutput(), filter->GetOutput()->GetPointData()->GetScalars()};
}

}  // namespace

Figure volume_figure(const Pair &pair, const View &from) {
  View view = from;
  const Shape surface = surface_of(pair.original);
  fit(view, surface.points, kPanelWidth, kHeight);
  Volume volume(view, surface.points, kDepths, pair.scale);
  volume.fill(in_tets(pair.original));
  const auto opacity = opacity_by_rarity(volume, kBins);
  auto images = std::make_shared<std::array<Image, 2>>();
  (*images)[0] = volume.image(opacity);
  volume = Volume(view, surface.points, kDepths, pair.scale);
  volume.fill(pair.simplified);
  (*images)[1] = volume.image(opacity);
  const auto shadows = std::make_shared<std::array<Image, 2>>(
      std::array<Image, 2>{shadow_of(surface, view), shadow_of(surface_of(pair.simplified), view)});
  Figure figure{"volume", "Inside", "", kPageWidth, kHead + kHeight + kFoot, {}};
  figure.caption =
      "Through the volume as through coloured smoke (the paper's Figure 9), denser where a value is rarer in the "
      "original, "
      "so that what differs from its surroundings shows, in the shadow of the mesh. One camera, one colour map, one "
      "density.";
  figure.draw = [images, shadows, pair](Canvas &page) {
    for (int side = 0; side < 2; side++) {
      const int left = side == 0 ? 0 : kPageWidth - kPanelWidth;
      page.text(pair.captions[side], left + kPanelWidth / 2.0, kHead / 2.0, kCaptionSize, Align::centre, true);
      page.picture((*shadows)[std::size_t(side)], left, kHead);
      page.picture((*images)[std::size_t(side)], left, kHead);
    }
    page.colour_bar(kBarLeft, kHead + kHeight + 12, kBarWidth, pair.scale, field_colour, pair.axis);
  };
  return figure;
}

}  // namespace cli
