#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/base/whole_file.hpp"
#include "framework/picture/cloud_view.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

bool is(const Colour& a, const Colour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

TEST(CloudView, DrawsEachPointWhereItIsInTheReferencesFrame) {
  RigidTransform T;
  T.translation = {1.0, 0.0, 0.0};
  const CloudView view = {4.0, 2.0, 1.0};
  const Image image = draw_view(
      {{"top", {{-3.5F, 1.5F, 0.0F}}, {}}, {"left", {{0.5F, -1.5F, 9.0F}, {50.0F, 0.0F, 0.0F}}, T}},
      view);
  ASSERT_EQ(image.width(), 8);
  ASSERT_EQ(image.height(), 4);
  int drawn = 0;
  for (const Colour& pixel : image.pixels()) drawn += is(pixel, {255, 255, 255}) ? 0 : 1;
  EXPECT_EQ(drawn, 2);
  EXPECT_TRUE(is(image.at(0, 0), sensor_colour(0)));
  EXPECT_TRUE(is(image.at(5, 3), sensor_colour(1)));
}

TEST(Image, StandsBesideOthersWithAGap) {
  const Image whole = side_by_side({Image(3, 2, {1, 2, 3}), Image(2, 4, {4, 5, 6})}, 2);
  EXPECT_EQ(whole.width(), 7);
  EXPECT_EQ(whole.height(), 4);
  EXPECT_TRUE(is(whole.at(2, 1), {1, 2, 3}));
  EXPECT_TRUE(is(whole.at(2, 2), {255, 255, 255}));
  EXPECT_TRUE(is(whole.at(4, 0), {255, 255, 255}));
  EXPECT_TRUE(is(whole.at(5, 3), {4, 5, 6}));
}

TEST(CloudView, HasALegendAndABarOfARoundLength) {
  EXPECT_EQ(scale_bar_m(40.0), 10.0);
  EXPECT_EQ(scale_bar_m(60.0), 10.0);
  EXPECT_EQ(scale_bar_m(8.0), 2.0);
  EXPECT_EQ(scale_bar_m(30.0), 5.0);
  const Image image =
      with_legend({Image(400, 200), Image(400, 200)}, {"before", "after"}, {"top", "left"}, 0.1);
  EXPECT_EQ(image.width(), 808);
  EXPECT_GT(image.height(), 250);
  std::size_t bar = 0;
  std::set<int> colours;
  std::size_t caption = 0;
  for (int y = 0; y < image.height(); ++y) {
    std::size_t run = 0;
    for (int x = 0; x < image.width(); ++x) {
      const Colour& pixel = image.at(x, y);
      colours.insert((pixel.red << 16) + (pixel.green << 8) + pixel.blue);
      run = is(pixel, {0x22, 0x22, 0x22}) ? run + 1 : 0;
      bar = std::max(bar, run);
      if (y < 48 && !is(pixel, {255, 255, 255})) ++caption;
      const bool is_in_view = y >= 48 && y < 248;
      if (is_in_view) {
        EXPECT_TRUE(is(pixel, {255, 255, 255}));
      }
    }
  }
  EXPECT_EQ(bar, 100U);  // 10 m.
  EXPECT_GT(caption, 100U);
  for (const std::size_t sensor : {0U, 1U}) {
    const Colour colour = sensor_colour(sensor);
    EXPECT_EQ(colours.count((colour.red << 16) + (colour.green << 8) + colour.blue), 1U);
  }
}

TEST(Image, IsWrittenAsPng) {
  const TempFolder folder;
  write_png(folder.path() / "image.png", Image(5, 4));
  const std::string bytes = read_whole_file(folder.path() / "image.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes[19], 5);
  EXPECT_EQ(bytes[23], 4);
}

}  // namespace
}  // namespace croon::test
