#include "image.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

// A step that nobody sees makes a file with shaded surfaces a third smaller. White and black stay.
std::uint8_t coarse(std::uint8_t channel) {
  return channel >= 254 ? 255 : static_cast<std::uint8_t>((channel + 2) / 4 * 4);
}

}  // namespace

void blend(std::uint8_t *pixel, const Colour &colour, double opacity) {
  const double over[3] = {colour.red, colour.green, colour.blue};
  const double under = pixel[3] / 255.0 * (1 - opacity), whole = under + opacity;
  if (whole <= 0) return;
  for (int c = 0; c < 3; c++) {
    const double mix = (opacity * 255.0 * over[c] + under * pixel[c]) / whole;
    pixel[c] = static_cast<std::uint8_t>(std::lround(std::clamp(mix, 0.0, 255.0)));
  }
  pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * whole));
}

std::string png_of(const Image &image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < image.height; y++) {  // VTK's rows begin at the bottom
    auto *row = static_cast<std::uint8_t *>(data->GetScalarPointer(0, image.height - 1 - y, 0));
    for (int x = 0; x < image.width; x++) std::transform(image.pixel(x, y), image.pixel(x, y) + 3, row + 3 * x, coarse);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetCompressionLevel(6);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  return {reinterpret_cast<const char *>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

}  // namespace cli
