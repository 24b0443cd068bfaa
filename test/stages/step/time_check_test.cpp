#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/stage/times.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

/// The scan of a LiDAR that turns once in 0.1 s, beginning at `begin_s`; reversed times if asked.
std::shared_ptr<const Cloud> scan(double begin_s, bool is_reversed = false) {
  PointCloud cloud;
  std::vector<double> times;
  for (int column = 0; column < 360; ++column) {
    for (int ring = 0; ring < 8; ++ring) {
      const double azimuth = rad_from_deg(column), z = 0.2 * ring;
      cloud.points.emplace_back(static_cast<float>(10.0 * std::cos(azimuth)),
                                static_cast<float>(10.0 * std::sin(azimuth)),
                                static_cast<float>(z));
      const double turned = (is_reversed ? 360 - column : column) / 360.0;
      times.push_back(begin_s + 0.1 * turned);
    }
  }
  set_channel(cloud, make_channel(kTime, times));
  return std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
}

std::shared_ptr<const Cloud> without_times(const std::shared_ptr<const Cloud>& cloud) {
  PointCloud untimed;
  untimed.points = cloud->points();
  return std::make_shared<const Cloud>(std::move(untimed), StreamKey(1));
}

Estimate checked(std::shared_ptr<const Cloud> target, std::shared_ptr<const Cloud> source,
                 const std::string& parameters = "") {
  Estimate estimate;
  estimate.take_clouds(std::move(target), std::move(source));
  Rng rng = test::test_rng();
  return test::stage<Step>(R"({"step": "time_check")" + parameters + "}")->advance(estimate, rng);
}

bool has_times(const Cloud& cloud) { return find_channel(cloud.with_channels(), kTime) != nullptr; }

TEST(TimeCheck, KeepsCloudsWithUsableTimesAsTheyAre) {
  const auto target = scan(5.0), source = scan(5.02);
  const Estimate after = checked(target, source);
  EXPECT_EQ(after.target, target);
  EXPECT_EQ(after.source, source);
  EXPECT_EQ(after.extras.find(kTimesInDoubt), nullptr);
  EXPECT_EQ(test::diagnostic(after, "has_usable_times"), 1.0);
}

TEST(TimeCheck, RemovesTheTimesOfBothCloudsIfThoseOfOneAreUnusable) {
  const auto good = scan(5.0);
  for (const auto& bad : {scan(5.0, true), without_times(good)}) {
    for (const Estimate& after : {checked(good, bad), checked(bad, good)}) {
      EXPECT_FALSE(has_times(*after.target));
      EXPECT_FALSE(has_times(*after.source));
      EXPECT_EQ(after.target->points(), good->points());
      ASSERT_NE(after.extras.find(kTimesInDoubt), nullptr);
      EXPECT_FALSE(after.extras.get(kTimesInDoubt).are_clocks_apart);
      EXPECT_EQ(test::diagnostic(after, "has_usable_times"), 0.0);
    }
  }
  EXPECT_FALSE(has_times(*checked(good, scan(5.0), R"(, "ignore_times": true)").target));
}

TEST(TimeCheck, RemovesTheTimesOfDifferentClocks) {
  const Estimate after = checked(scan(5.0), scan(5.1));
  EXPECT_FALSE(has_times(*after.target));
  EXPECT_TRUE(after.extras.get(kTimesInDoubt).are_clocks_apart);
}

}  // namespace
}  // namespace croon
