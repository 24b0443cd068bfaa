#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(Preprocessing, WorksOnEachCloudInOrderAndOnce) {
  const auto step = test::stage<Step>(R"({"step": "preprocessing",
    "reference": [{"type": "voxel_downsample", "leaf_size_m": 0.5}],
    "sensor": [{"type": "range_crop", "min_m": 2.0, "max_m": 10.0}, {"type": "range_crop", "min_m": 3.0}]})");
  Rng rng = test::test_rng();
  const test::StreetEstimate street = test::street_estimate(8);
  const Estimate after = step->advance(street.estimate, rng);
  EXPECT_LT(after.target->points().size(), street.estimate.target->points().size());
  EXPECT_FALSE(after.source->empty());
  for (const Eigen::Vector3f& point : after.source->points()) {
    EXPECT_GE(point.norm(), 3.0F);
    EXPECT_LE(point.norm(), 10.0F);
  }
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
