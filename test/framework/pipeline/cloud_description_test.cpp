#include "framework/pipeline/cloud_description.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

params::Slot<GroundExtractor> ransac() {
  return test::stage<GroundExtractor>(R"({"type": "ransac"})");
}

TEST(CloudDescription, AreThoseOfAKnownCloud) {
  // A level square of 400 points 2 m below the sensor, and 100 points in one leaf above it.
  Points points;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      points.emplace_back(0.5F * static_cast<float>(i) + 0.05F,
                          0.5F * static_cast<float>(j) + 0.05F, -1.95F);
    }
  }
  for (int i = 0; i < 100; ++i) points.emplace_back(0.05F, 0.05F, 3.05F);
  const CloudDescription description = description_of(points, *ransac());
  EXPECT_EQ(description.points, 500U);
  EXPECT_NEAR(description.ground_ratio, 0.8, 1e-12);
  EXPECT_NEAR(description.occupied_volume_m3, 401 * 1e-3, 1e-12);
  EXPECT_NEAR(
      std::accumulate(description.range_shares.begin(), description.range_shares.end(), 0.0), 1.0,
      1e-9);
  EXPECT_FALSE(description.overlap_ratio.has_value());
}

TEST(CloudDescription, BinsHoldTheirRanges) {
  for (std::size_t bin = 0; bin < kRangeBins; ++bin) {
    const auto range_m = static_cast<float>(range_bin_m(bin) * 1.01);
    const CloudDescription description = description_of({{range_m, 0.0F, 0.0F}}, *ransac());
    EXPECT_EQ(description.range_shares[bin], 1.0);
    EXPECT_NEAR(description.median_range_m, range_m, 1e-6);
  }
}

TEST(CloudDescription, OverlapIsThatOfTheTruth) {
  Rng rng = test::test_rng();
  const Points reference = test::random_cloud(rng, 500, 10.0);
  const RigidTransform T = test::random_pose(rng, 2.0);
  Points seen = transformed(reference, T.inverse());
  seen.emplace_back(1000.0F, 0.0F, 0.0F);
  CloudDescription description = description_of(seen, *ransac());
  add_overlap(description, seen, KdTree(reference), T);
  EXPECT_NEAR(*description.overlap_ratio, 500.0 / 501.0, 1e-12);
  EXPECT_LT(*description.median_distance_m, 1e-5);
}

}  // namespace
}  // namespace croon
