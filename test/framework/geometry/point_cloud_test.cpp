#include "framework/geometry/point_cloud.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/base/error.hpp"
#include "framework/geometry/measured_points.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// Points whose x, ring and descriptor are their index.
PointCloud numbered(int count) {
  PointCloud cloud;
  std::vector<std::uint16_t> ring;
  std::vector<float> descriptor;
  for (int i = 0; i < count; ++i) {
    cloud.points.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    ring.push_back(static_cast<std::uint16_t>(i));
    descriptor.insert(descriptor.end(), {static_cast<float>(i), -1.0F});
  }
  cloud.channels = {make_channel(kRing, ring), make_channel("descriptor", descriptor)};
  cloud.channels[1].count = 2;
  return cloud;
}

TEST(MeasuredPoints, AreTheCountsOfMeansAndAtLeastOne) {
  PointCloud cloud = numbered(5);
  EXPECT_THAT(measured_points(cloud), testing::Each(1U));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud.channels.push_back(make_channel(kMeanOf, std::vector<double>{0.0, 3.0, nan, 1e12, -7.0}));
  EXPECT_THAT(measured_points(cloud), testing::ElementsAre(1U, 3U, 1U, 1000000000U, 1U));
}

TEST(PointCloud, SelectionKeepsTheChannelsOfEachPoint) {
  Rng rng = test::test_rng();
  const PointCloud cloud = numbered(50);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<std::size_t> indices;
    for (std::uint64_t i = rng.below(60); i > 0; --i) indices.push_back(rng.below(50));
    const PointCloud chosen = selected(cloud, indices);
    ASSERT_EQ(chosen.size(), indices.size());
    const std::vector<double> ring = channel_values(chosen, kRing);
    const std::vector<double> descriptor = channel_values(chosen, "descriptor");
    for (std::size_t i = 0; i < indices.size(); ++i) {
      EXPECT_EQ(chosen.points[i].x(), static_cast<float>(indices[i]));
      EXPECT_EQ(ring[i], static_cast<double>(indices[i]));
      EXPECT_EQ(descriptor[i], static_cast<double>(indices[i]));
    }
    EXPECT_EQ(chosen.channels[1].bytes.size(), indices.size() * 8);
  }
}

TEST(PointCloud, NamesTheChannelsThatThereAre) {
  const auto message_of = [](const PointCloud& cloud) {
    try {
      times_s(cloud);
    } catch (const StageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of(numbered(1)), "the cloud has no channel \"time\"; it has ring, descriptor");
  EXPECT_EQ(message_of(Points{{1, 2, 3}}), "the cloud has no channel \"time\"; it has none");
}

TEST(PointCloud, TimesAreSecondsOrWholeNanoseconds) {
  PointCloud cloud = Points(2, Eigen::Vector3f::Zero());
  cloud.channels = {make_channel(kTime, std::vector<double>{0.5, 1.25})};
  EXPECT_EQ(times_s(cloud), (std::vector{0.5, 1.25}));
  cloud.channels = {make_channel(kTime, std::vector<std::uint32_t>{500000000, 1250000000})};
  EXPECT_THAT(times_s(cloud),
              ::testing::ElementsAre(::testing::DoubleEq(0.5), ::testing::DoubleEq(1.25)));
}

}  // namespace
}  // namespace croon
