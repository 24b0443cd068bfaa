#include "framework/registration/beam_errors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/pose_covariance.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// A street without noise, seen by two sensors.
struct BeamStreet {
  explicit BeamStreet(std::uint64_t seed)
      : rng(test_rng(seed)),
        pair(street_pair(rng, seed, T, 30000, 20000, 0.0)),
        target(PointCloud(std::move(pair.target)), StreamKey(seed)),
        source(PointCloud(std::move(pair.source)), StreamKey(seed)) {}

  Matrix6d covariance(const BeamErrors& errors) const {
    return covariance_of_beam_errors({{&target, &source, T}}, errors).value();
  }

  RigidTransform T = {rotation_from_rpy({0.1, -0.05, 1.2}), {0.5, 0.6, -0.2}};
  Rng rng;
  StreetPair pair;
  Cloud target, source;
};

TEST(BeamErrors, MovePosesByAboutTheirSize) {
  const BeamStreet street(1);
  const Matrix6d angles = street.covariance({rad_from_deg(0.1), rad_from_deg(0.1), 0.0});
  EXPECT_TRUE(is_covariance(angles));
  const double yaw_deg = deg_from_rad(std::sqrt(angles(2, 2)));
  EXPECT_GT(yaw_deg, 0.02);
  EXPECT_LT(yaw_deg, 0.5);
  const Matrix6d ranges = street.covariance({0.0, 0.0, 0.02});
  EXPECT_GT(std::sqrt(ranges(5, 5)), 0.002);
  EXPECT_LT(ranges.diagonal().tail<3>().cwiseSqrt().maxCoeff(), 0.1);
}

TEST(BeamErrors, ScaleWithTheErrors) {
  const BeamStreet street(2);
  const BeamErrors errors = {rad_from_deg(0.1), rad_from_deg(0.05), 0.02};
  const BeamErrors twice = {2.0 * errors.azimuth_rad, 2.0 * errors.elevation_rad,
                            2.0 * errors.range_m};
  const Matrix6d once = street.covariance(errors);
  EXPECT_LT((street.covariance(twice) - 4.0 * once).norm(), 1e-9 * once.norm());
  EXPECT_TRUE(street.covariance({}).isZero(0.0));
}

TEST(BeamErrors, AreTheSameInAllScans) {
  const BeamStreet street(3);
  const BeamErrors errors = {rad_from_deg(0.1), rad_from_deg(0.1), 0.02};
  const ComparedScan scan = {&street.target, &street.source, street.T};
  const Matrix6d once = covariance_of_beam_errors({scan}, errors).value();
  // A second scan of the same surfaces does not average the errors out.
  const Matrix6d twice = covariance_of_beam_errors({scan, scan}, errors).value();
  EXPECT_NEAR(twice.trace() / once.trace(), 1.0, 0.2);
}

TEST(BeamErrors, WithoutTouchesTheyAreUnknown) {
  EXPECT_FALSE(covariance_of_beam_errors({}, {0.1, 0.1, 0.1}));
}

}  // namespace
}  // namespace croon::test
