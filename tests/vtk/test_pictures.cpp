// What the tool's pictures are drawn with: numbers along axes, colours, and the raster.
#include <gtest/gtest.h>
#include <vtkPointData.h>

#include <cmath>
#include <set>
#include <string>

#include "colour_map.hpp"
#include "filter_fixture.hpp"
#include "raster.hpp"
#include "scale.hpp"
#include "volume.hpp"

namespace vtk_test {
namespace {

using namespace cli;

TEST(Scale, TicksAreRoundNumbersWithinTheEnds) {
  EXPECT_EQ(ticks_of({0, 10, false}), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks_of({0.2, 30, true}), (std::vector<double>{0.2, 0.5, 1, 2, 5, 10, 20}));
  for (const double least : {-1e-7, 0.0, 3.7, 1e12}) {
    const Scale scale{least, least + 0.123 * (1 + std::abs(least)), false};
    const auto ticks = ticks_of(scale);
    EXPECT_GE(ticks.size(), 3U);
    EXPECT_LE(ticks.size(), 9U);
    for (const double tick : ticks) EXPECT_TRUE(tick >= scale.low && tick <= scale.high * (1 + 1e-12)) << tick;
  }
}

// So many values between two, evenly, or so that each is as many times the one before.
std::vector<double> spread(double from, double to, bool evenly) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; i++) values.push_back(Scale{from, to, !evenly}.value(i / 1000.0));
  return values;
}

TEST(Scale, IsLogarithmicForPositiveValuesOfManySizesAlone) {
  EXPECT_TRUE(scale_for(spread(0.1, 20, false)).logarithmic);
  EXPECT_FALSE(scale_for(spread(0.01, 20, true)).logarithmic) << "half of them would have a tenth of the scale";
  EXPECT_FALSE(scale_for(spread(1, 4, false)).logarithmic);
  EXPECT_FALSE(scale_for(spread(0, 9, true)).logarithmic);
  EXPECT_FALSE(scale_for(spread(-1, 9, true)).logarithmic);
  EXPECT_FALSE(scale_for({7}).logarithmic);
  EXPECT_EQ(scale_for({}).high, 1);
  EXPECT_EQ(scale_for(spread(3, 5, true)).low, 3);
  EXPECT_EQ(scale_for(spread(3, 5, true)).high, 5);
  for (const Scale &scale : {Scale{0.1, 2, true}, Scale{-3, 9, false}}) {
    for (const double share : {0.0, 0.3, 1.0}) EXPECT_NEAR(scale.share(scale.value(share)), share, 1e-12);
  }
}

TEST(Scale, BeginsAtAThousandthWhereNearlyAllIsNextToZero) {
  std::vector<double> values = spread(2, 1e4, false);
  values.insert(values.end(), 20000, 0.0);
  const Scale scale = scale_for(values);
  EXPECT_TRUE(scale.logarithmic);
  EXPECT_EQ(scale.low, 10);
  EXPECT_EQ(scale.high, 1e4);
  EXPECT_EQ(scale.share(0), 0);
}

TEST(Scale, AConstantFieldHasATick) {
  EXPECT_EQ(ticks_of({4, 4, false}), std::vector<double>{4});
  EXPECT_EQ(Scale({4, 4, false}).share(4), 0.5);
}

TEST(Scale, AFieldThatIsConstantButForRoundingHasATick) {
  for (const double value : {0.2, -0.2, 1e300, 1e-300}) {
    const double next = std::nextafter(value, 2 * std::abs(value));
    EXPECT_EQ(ticks_of({value, next, false}), std::vector<double>{value});
  }
}

TEST(Scale, NumbersThatAreLargeBesideTheirRangeAreToldApart) {
  EXPECT_EQ(number_text(1000000.25, {1e6, 1e6 + 1.48, false}), "1000000.25");
  EXPECT_EQ(number_text(-2.00002, {-2.0001, -2, false}), "-2.00002");
  EXPECT_EQ(number_text(1234567, {0, 2e6, false}), number_text(1234567));
  EXPECT_EQ(number_text(7, {7, 7, false}), "7");
  for (const double high : {1e6 + 1e-3, 1e6 + 1, 2e6}) {
    const Scale scale{1e6, high, false};
    std::set<std::string> texts;
    for (const double tick : ticks_of(scale)) texts.insert(number_text(tick, scale));
    EXPECT_EQ(texts.size(), ticks_of(scale).size()) << high;
  }
}

TEST(Scale, NumbersAreShort) {
  EXPECT_EQ(number_text(0.000012), "1.2e-5");
  EXPECT_EQ(number_text(3.314e-7), "3.314e-7");
  EXPECT_EQ(number_text(30243.4), "30,240");
  EXPECT_EQ(number_text(3207), "3,207");
  EXPECT_EQ(number_text(-1000), "-1,000");
  EXPECT_EQ(number_text(999.94), "999.9");
  EXPECT_EQ(number_text(-1234567), "-1,235,000");
  EXPECT_EQ(number_text(0.25), "0.25");
  EXPECT_EQ(count_text(1234567), "1,234,567");
  EXPECT_EQ(count_text(-123), "-123");
}

TEST(Scale, LongNamesAreShortened) {
  EXPECT_EQ(shortened("density", 7), "density");
  EXPECT_EQ(shortened("density of the gas", 11), "dens... gas");
  for (std::size_t most = 4; most < 20; most++) {
    const std::string name =
        shortened("\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4", most);
    EXPECT_LE(name.size(), most);
    EXPECT_EQ((name.size() - 3) % 2, 0U) << "no letter of two bytes is cut in two";
  }
}

double lightness(const Colour &c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

// So that the maps can be read without colours.
TEST(Colours, TheLightnessAloneTellsValuesApart) {
  for (int i = 0; i < 100; i++) {
    const double share = i / 100.0, next = share + 0.01;
    EXPECT_GT(lightness(field_colour(next)), lightness(field_colour(share))) << share;
    EXPECT_LT(lightness(error_colour(next)), lightness(error_colour(share))) << share;
  }
}

// A square of two triangles that covers the left half of the picture, at a height above the screen.
Shape left_half(double height, double value) {
  Shape shape;
  shape.points = {{-1, -1, height}, {0, -1, height}, {0, 1, height}, {-1, 1, height}};
  shape.values = {value, value, value, value};
  shape.triangles = {{0, 1, 2}, {0, 2, 3}};
  return shape;
}

View straight() {
  View view;
  view.pixels = 10;
  view.width = view.height = 20;
  return view;
}

TEST(Raster, CoversWhatItShould) {
  Raster raster(20, 20, 2);
  raster.draw_triangles(left_half(0, 7), straight());
  std::size_t covered = 0;
  for (const auto &sample : raster.samples()) {
    covered += sample.covered() ? 1 : 0;
    if (sample.covered()) {
      EXPECT_NEAR(sample.value, 7, 1e-12);
    }
  }
  EXPECT_EQ(covered, raster.samples().size() / 2);
  const Image image = raster.image([](const Raster::Sample &) { return Colour{1, 0, 0}; });
  EXPECT_EQ(image.pixel(4, 10)[3], 255);
  EXPECT_EQ(image.pixel(15, 10)[3], 0);
}

TEST(Raster, ValuesMayBeLargeBesideTheirRange) {
  Raster raster(20, 20, 1);
  raster.draw_triangles(left_half(0, 1e9 + 0.25), straight());
  EXPECT_NEAR(raster.samples()[10 * 20 + 5].value - 1e9, 0.25, 1e-6);
}

TEST(Raster, TheNearestIsSeenInWhateverOrder) {
  for (const bool near_first : {true, false}) {
    Raster raster(20, 20, 1);
    raster.draw_triangles(left_half(near_first ? 1 : 0, near_first ? 1 : 0), straight());
    raster.draw_triangles(left_half(near_first ? 0 : 1, near_first ? 0 : 1), straight());
    EXPECT_NEAR(raster.samples()[10 * 20 + 5].value, 1, 1e-12);
  }
}

TEST(Raster, ValuesVaryLinearly) {
  Shape shape = left_half(0, 0);
  for (std::size_t k = 0; k < 4; k++) shape.values[k] = shape.points[k][0] + 2 * shape.points[k][1];
  Raster raster(20, 20, 1);
  raster.draw_triangles(shape, straight());
  for (std::size_t y = 0; y < 20; y++) {
    for (std::size_t x = 0; x < 10; x++) {
      const double right = (double(x) + 0.5 - 10) / 10, up = (10 - double(y) - 0.5) / 10;
      EXPECT_NEAR(double(raster.samples()[y * 20 + x].value), right + 2 * up, 1e-6);
    }
  }
}

// heat = x + 2 y + 3 z in the unit cube, looked at along z: 40 pixels wide, of which the cube has 92 %.
TEST(Volume, HasTheFieldWhereTheMeshIs) {
  const Grid grid = cube_grid();
  View view = view_along(2, {1, 1, 1});
  std::vector<Vector> corners;
  for (int c = 0; c < 8; c++) corners.push_back({double(c & 1), double(c >> 1 & 1), double(c >> 2 & 1)});
  fit(view, corners, 40, 40);
  constexpr int depths = 10;
  const Scale scale{0, 6, false};
  Volume volume(view, corners, depths, scale);
  volume.fill({grid, grid->GetPointData()->GetScalars()});
  std::size_t inside = 0;
  for (int i = 0; i < 40 * 40 * depths; i++) {
    const float share = volume.shares()[std::size_t(i)];
    if (!std::isfinite(share)) continue;
    const double x = (i / depths % 40 + 0.5 - 20) / view.pixels + 0.5,
                 y = (20 - 0.5 - i / depths / 40) / view.pixels + 0.5;
    EXPECT_NEAR(scale.value(double(share)),
                x + 2 * y + 3 * (i % depths + Volume::place(i / depths % 40, i / depths / 40)) / depths, 1e-5);
    inside++;
  }
  EXPECT_NEAR(double(inside), 0.92 * 40 * 0.92 * 40 * depths, 0.06 * 40 * 40 * depths);
  const Image image = volume.image(opacity_by_rarity(volume, 16));
  EXPECT_EQ(image.pixel(0, 0)[3], 0) << "beside the cube";
  EXPECT_GT(image.pixel(20, 20)[3], 30);
  EXPECT_GT(image.pixel(37, 3)[3], image.pixel(20, 20)[3]) << "rare values are denser: the corner's are the largest";
}

TEST(View, FitsWhatItShows) {
  const std::vector<Vector> points = {{5, 5, 5}, {9, 6, 5}, {5, 6, 8}};
  for (int corner = 0; corner < 8; corner++) {
    View view = view_from_corner(corner, {4, 1, 3});
    EXPECT_NEAR(dot(view.right, view.up), 0, 1e-12);
    EXPECT_NEAR(dot(cross(view.right, view.up), view.toward), 1, 1e-12) << "right-handed";
    fit(view, points, 300, 200);
    for (const Vector &p : points) {
      const Vector at = view.project(p);
      EXPECT_TRUE(at[0] > 0 && at[0] < 300 && at[1] > 0 && at[1] < 200);
    }
  }
}

}  // namespace
}  // namespace vtk_test
