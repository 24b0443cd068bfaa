#include <gtest/gtest.h>

#include "framework/stage/preprocessor.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(Preprocessing, WorksOnEachCloudInOrderAndOnce) {
  const auto step = test::stage<Step>(R"({"step": "preprocessing",
    "reference": [{"type": "voxel_downsample", "leaf_size_m": 0.5}],
    "sensor": [{"type": "range_crop", "min_m": 3.0, "max_m": 10.0}, {"type": "voxel_downsample", "leaf_size_m": 1.0}]})");
  Rng rng = test::test_rng();
  const test::StreetEstimate street = test::street_estimate(8);
  const Estimate after = step->advance(street.estimate, rng);
  EXPECT_LT(after.target->points().size(), street.estimate.target->points().size());
  EXPECT_FALSE(after.source->empty());
  // In the other order a leaf that the crop cuts has another mean.
  const auto applied = [](const std::string& stage, const PointCloud& cloud) {
    return test::stage<Preprocessor>(stage)->apply(cloud);
  };
  const std::string crop = R"({"type": "range_crop", "min_m": 3.0, "max_m": 10.0})";
  const std::string thin = R"({"type": "voxel_downsample", "leaf_size_m": 1.0})";
  const PointCloud& all = street.estimate.source->with_channels();
  EXPECT_EQ(after.source->points(), applied(thin, applied(crop, all)).points);
  EXPECT_NE(after.source->points(), applied(crop, applied(thin, all)).points);
  EXPECT_EQ(step->advance(street.estimate, rng).target, after.target);
  EXPECT_EQ(step->advance(street.estimate, rng).source, after.source);
}

TEST(Preprocessing, WithNothingToDoKeepsTheClouds) {
  const auto step = test::stage<Step>(R"({"step": "preprocessing"})");
  Rng rng = test::test_rng();
  const test::StreetEstimate street = test::street_estimate(8);
  const Estimate after = step->advance(street.estimate, rng);
  EXPECT_EQ(after.target, street.estimate.target);
  EXPECT_EQ(after.source, street.estimate.source);
}

}  // namespace
}  // namespace croon
