#include "framework/spatial/range_image.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(RangeImage, KnowsTheRangeOfEveryReturn) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 5000, 20.0);
  const RangeImage image(cloud, 90);
  for (const Eigen::Vector3f& point : cloud) {
    const auto seen = image.at(point.cast<double>());
    ASSERT_TRUE(seen);
    EXPECT_LE(seen->nearest_m, point.norm());
    EXPECT_GE(seen->farthest_m, point.norm());
  }
}

TEST(RangeImage, TellsFrontFromBehindInAllDirections) {
  Rng rng = test::test_rng(2);
  Points sphere;
  for (int i = 0; i < 400000; ++i) {
    const Eigen::Vector3d towards{rng.normal(), rng.normal(), rng.normal()};
    sphere.push_back((10.0 * towards.normalized()).cast<float>());
  }
  const RangeImage image(sphere, 60);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d towards =
        Eigen::Vector3d{rng.normal(), rng.normal(), rng.normal()}.normalized();
    const auto seen = image.at(3.0 * towards);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->nearest_m, 10.0, 1e-4);
    EXPECT_NEAR(seen->farthest_m, 10.0, 1e-4);
  }
}

TEST(RangeImage, SeesNothingWhereNothingCameBack) {
  const RangeImage image({{5.0F, 0.0F, 0.0F}}, 90);
  EXPECT_TRUE(image.at({1.0, 0.0, 0.0}));
  EXPECT_FALSE(image.at({-1.0, 0.0, 0.0}));
  EXPECT_FALSE(image.at({0.0, 0.0, 1.0}));
  EXPECT_FALSE(RangeImage({}, 90).at({1.0, 0.0, 0.0}));
  EXPECT_FALSE(RangeImage({{0.0F, 0.0F, 0.0F}}, 90).at({0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace croon
