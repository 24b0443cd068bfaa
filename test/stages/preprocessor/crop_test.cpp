#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/stage/preprocessor.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

Points cropped(const std::string& json, const Points& cloud) {
  return test::stage<Preprocessor>(json)->apply(cloud).points;
}

std::string crop_error(const std::string& json) {
  return test::input_error([&] { test::build_stage("preprocessor", json); });
}

TEST(RangeCrop, KeepsTheBoundsAndTheOrder) {
  const Points cloud = {{1, 0, 0}, {0, 0.999f, 0}, {0, 0, -200},
                        {0, 0, 0}, {200, 1, 0},    {3, 4, 12}};
  EXPECT_EQ(cropped(R"({"type": "range_crop"})", cloud),
            (Points{{1, 0, 0}, {0, 0, -200}, {3, 4, 12}}));
  EXPECT_EQ(cropped(R"({"type": "range_crop", "min_m": 13, "max_m": 13})", cloud),
            (Points{{3, 4, 12}}));
  EXPECT_TRUE(cropped(R"({"type": "range_crop"})", {}).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(cropped(R"({"type": "range_crop"})", {{nan, 3, 0}}).empty());
}

TEST(RangeCrop, SplitsTheCloudAtARange) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 1000, 10.0);
  const Points near = cropped(R"({"type": "range_crop", "min_m": 0, "max_m": 7})", cloud);
  const Points far = cropped(R"({"type": "range_crop", "min_m": 7, "max_m": 100})", cloud);
  EXPECT_GT(near.size(), 0u);
  EXPECT_GT(far.size(), 0u);
  EXPECT_EQ(near.size() + far.size(), cloud.size());
}

TEST(BoxCrop, PartsTheCloudInOrder) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 1000, 3.0);
  const std::string box = R"({"type": "box_crop", "min_m": [-2, -1, 0], "max_m": [1, 2, 2.5])";
  const Points outside = cropped(box + "}", cloud);
  const Points inside = cropped(box + R"(, "keep": "inside"})", cloud);
  Points expected_inside, expected_outside;
  for (const Eigen::Vector3f& p : cloud) {
    const bool is_inside =
        p.x() >= -2 && p.x() <= 1 && p.y() >= -1 && p.y() <= 2 && p.z() >= 0 && p.z() <= 2.5f;
    (is_inside ? expected_inside : expected_outside).push_back(p);
  }
  EXPECT_EQ(inside, expected_inside);
  EXPECT_EQ(outside, expected_outside);
  EXPECT_GT(inside.size(), 0u);
}

TEST(BoxCrop, HasItsFacesInside) {
  const Points cloud = {{1, 1, 1}, {-1, 0, 0}, {1.001f, 0, 0}};
  EXPECT_EQ(cropped(R"({"type": "box_crop"})", cloud), (Points{{1.001f, 0, 0}}));
}

TEST(Crops, RefuseBoundsThatAreNone) {
  EXPECT_THAT(crop_error(R"({"type": "range_crop", "min_m": 5, "max_m": 4})"),
              HasSubstr("min_m must not be above"));
  EXPECT_THAT(crop_error(R"({"type": "box_crop", "min_m": [1, 2]})"),
              HasSubstr("three numbers each"));
  EXPECT_THAT(crop_error(R"({"type": "box_crop", "max_m": [1, 2, 3, 4]})"),
              HasSubstr("three numbers each"));
  EXPECT_THAT(crop_error(R"({"type": "box_crop", "min_m": [0, 2, 0]})"),
              HasSubstr("min_m must not exceed"));
  EXPECT_THAT(crop_error(R"({"type": "box_crop", "keep": "both"})"),
              HasSubstr("expected one of outside, inside"));
}

}  // namespace
}  // namespace croon
