#include <gtest/gtest.h>

#include "framework/base/whole_file.hpp"
#include "framework/picture/top_view.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

bool is(const Colour& a, const Colour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

TEST(TopView, DrawsEachPointWhereItIsInTheReferencesFrame) {
  RigidTransform T;
  T.translation = {1.0, 0.0, 0.0};
  const TopView view = {4.0, 2.0, 1.0};
  const Image image = top_view(
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
