#include "framework/registration/scan_faults.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// A street with noise of 1 cm, seen by two sensors; `distort` changes each point of the source.
template <class Distort>
ScanFaults faults_of(std::uint64_t seed, const Distort& distort) {
  Rng rng = test_rng(seed);
  const RigidTransform T = {rotation_from_rpy({0.1, -0.05, 1.2}), {0.5, 0.6, -0.2}};
  StreetPair pair = street_pair(rng, seed, T, 30000, 20000, 0.01);
  for (Eigen::Vector3f& point : pair.source) point = distort(point);
  const StreamKey key(seed);
  const Cloud target(PointCloud(std::move(pair.target)), key);
  const Cloud source(PointCloud(std::move(pair.source)), key);
  return estimate_scan_faults({{&target, &source, T}});
}

Eigen::Vector3f longer(const Eigen::Vector3f& point, float scale, float offset_m) {
  return point * (1.0F + scale + offset_m / std::max(point.norm(), 0.1F));
}

TEST(ScanFaults, EstimatesTheScaleAndTheOffsetOfRanges) {
  for (const auto& [scale, offset_m] : {std::pair(0.0F, 0.0F), std::pair(0.005F, 0.0F),
                                        std::pair(-0.01F, 0.0F), std::pair(0.0F, 0.1F)}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const ScanFaults faults = faults_of(
          seed,
          [s = scale, o = offset_m](const Eigen::Vector3f& point) { return longer(point, s, o); });
      const RangeDifference& range = faults.range;
      // The number of deviations beyond which a fault counts.
      const double deviations = 5.0;
      // Points near edges touch surfaces that they are not on, which makes estimates too small.
      const double bias = 0.25;
      EXPECT_NEAR(range.scale, scale,
                  deviations * std::sqrt(range.covariance(0, 0)) + bias * std::abs(scale));
      EXPECT_NEAR(range.offset_m, offset_m,
                  deviations * std::sqrt(range.covariance(1, 1)) + bias * std::abs(offset_m));
      EXPECT_GT(faults.surfaces, 20.0);
    }
  }
}

TEST(ScanFaults, FindsAShiftedHalf) {
  const auto shifted = [](const Eigen::Vector3f& point) -> Eigen::Vector3f {
    return point.y() >= 0.0F ? Eigen::Vector3f(point + Eigen::Vector3f(0.0F, 0.0F, 0.15F)) : point;
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ScanFaults sound = faults_of(seed, [](const Eigen::Vector3f& point) { return point; });
    const ScanFaults faulty = faults_of(seed, shifted);
    ASSERT_EQ(faulty.halves.size(), 4U);
    EXPECT_GT(sound.halves[0].cost_ratio, 0.94);
    EXPECT_LT(faulty.halves[0].cost_ratio, 0.94);
    EXPECT_GT(faulty.halves[0].shift_m.z(), 0.08);
  }
}

TEST(ScanFaults, WithoutSharedSurfacesNothingIsEstimated) {
  EXPECT_EQ(estimate_scan_faults({}).surfaces, 0.0);
}

}  // namespace
}  // namespace croon::test
