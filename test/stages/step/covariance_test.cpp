#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/registration/pose_uncertainty.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

constexpr auto kDetermined = Observability::determined;
constexpr auto kUnobservable = Observability::unobservable;

Estimate judged(Estimate estimate, const std::string& parameters = "") {
  Rng rng = test::test_rng();
  return test::stage<Step>(R"({"step": "covariance")" + parameters + "}")
      ->advance(std::move(estimate), rng);
}

/// The standard deviation of a degree of freedom.
double std_of(const PoseCovariance& covariance, Dof dof) {
  const auto i = static_cast<Eigen::Index>(dof);
  return std::sqrt(covariance.matrix(i, i));
}

Observability word_of(const PoseCovariance& covariance, Dof dof) {
  return covariance.dofs.at(static_cast<std::size_t>(dof));
}

/// A level plain 2 m below the sensor, other points at each call.
Points plain(Rng& rng, double noise_m) {
  Points points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back(Eigen::Vector3d{rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0),
                                     -2.0 + noise_m * rng.normal()}
                         .cast<float>());
  }
  return points;
}

/// Ground and two walls along x, which go on at both ends.
Points corridor(Rng& rng, double noise_m) {
  Points points;
  for (int i = 0; i < 30000; ++i) {
    const auto along = static_cast<float>(rng.uniform(-30.0, 30.0));
    const auto across = static_cast<float>(rng.uniform(-4.0, 4.0));
    const auto up = static_cast<float>(rng.uniform(-2.0, 4.0));
    const auto noise = static_cast<float>(noise_m * rng.normal());
    if (i % 3 == 0) points.emplace_back(along, across, -2.0F + noise);
    if (i % 3 == 1) points.emplace_back(along, -4.0F + noise, up);
    if (i % 3 == 2) points.emplace_back(along, 4.0F + noise, up);
  }
  return points;
}

TEST(CovarianceStep, LeavesThePoseAsItIsAndReportsStandardDeviations) {
  Rng rng = test::test_rng();
  const test::StreetPair pair =
      test::street_pair(rng, 3, test::random_pose(rng, 0.5), 20000, 12000, 0.01);
  const Estimate before = test::estimate_of(pair.target, pair.source, pair.T_target_source);
  const Estimate after = judged(before);
  EXPECT_EQ(after.T_target_source.rotation, before.T_target_source.rotation);
  EXPECT_EQ(after.T_target_source.translation, before.T_target_source.translation);
  ASSERT_TRUE(after.covariance);
  EXPECT_TRUE(is_covariance(after.covariance->matrix));
  ASSERT_EQ(after.diagnostics.size(), 6U);
  EXPECT_EQ(after.diagnostics[2].first, "yaw_std_deg");
  EXPECT_EQ(after.diagnostics[2].second, deg_from_rad(std_of(*after.covariance, Dof::yaw)));
  EXPECT_EQ(after.diagnostics[5].first, "z_std_m");
}

TEST(CovarianceStep, AStreetDeterminesAllDegreesOfFreedom) {
  Rng rng = test::test_rng(2);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const test::StreetPair pair =
        test::street_pair(rng, i, test::random_pose(rng, 0.5), 20000, 12000, 0.01);
    const auto covariance =
        *judged(test::estimate_of(pair.target, pair.source, pair.T_target_source)).covariance;
    for (std::size_t k = 0; k < 6; ++k) {
      const double bound = k < 3 ? rad_from_deg(0.5) : 0.1;
      EXPECT_EQ(covariance.dofs.at(k), kDetermined) << i << " " << kDofNames.at(k);
      EXPECT_LT(std_of(covariance, static_cast<Dof>(k)), bound) << i << " " << kDofNames.at(k);
    }
  }
}

TEST(CovarianceStep, APlainAloneDoesNotHoldXYAndYaw) {
  Rng rng = test::test_rng(3);
  for (const double noise_m : {0.0, 0.005, 0.02}) {
    const Points target = plain(rng, noise_m);
    const auto covariance = *judged(test::estimate_of(target, plain(rng, noise_m), {})).covariance;
    for (const Dof dof : {Dof::x, Dof::y, Dof::yaw}) {
      EXPECT_EQ(word_of(covariance, dof), kUnobservable) << noise_m;
      EXPECT_GT(std_of(covariance, dof), 0.5) << noise_m;
    }
    for (const Dof dof : {Dof::z, Dof::roll, Dof::pitch}) {
      EXPECT_EQ(word_of(covariance, dof), kDetermined) << noise_m;
      EXPECT_LT(std_of(covariance, dof), 0.1);
    }
  }
}

TEST(CovarianceStep, ACorridorDoesNotHoldItsAxis) {
  Rng rng = test::test_rng(4);
  for (const double noise_m : {0.0, 0.005, 0.02}) {
    const Points target = corridor(rng, noise_m);
    const auto covariance =
        *judged(test::estimate_of(target, corridor(rng, noise_m), {})).covariance;
    EXPECT_NE(word_of(covariance, Dof::x), kDetermined) << noise_m;
    for (const Dof dof : {Dof::y, Dof::z, Dof::roll, Dof::pitch, Dof::yaw}) {
      EXPECT_EQ(word_of(covariance, dof), kDetermined) << noise_m;
    }
  }
}

/// The covariance between a reference that `tilt` turns in the world and a level sensor.
PoseCovariance of_tilted(const Points& target, const Points& source, const Eigen::Matrix3d& tilt) {
  const RigidTransform T_target_source{tilt, Eigen::Vector3d::Zero()};
  Points seen;
  for (const Eigen::Vector3f& point : target) {
    seen.push_back((T_target_source * point.cast<double>()).cast<float>());
  }
  return *judged(test::estimate_of(seen, source, T_target_source)).covariance;
}

TEST(CovarianceStep, ATiltOfTheReferenceDoesNotChangeWhatAPlainHolds) {
  Rng rng = test::test_rng(5);
  for (int i = 0; i < 5; ++i) {
    const double roll_rad = rad_from_deg(rng.uniform(-7.0, 7.0));
    const double pitch_rad = rad_from_deg(rng.uniform(-7.0, 7.0));
    const Points target = plain(rng, 0.01);
    const PoseCovariance covariance =
        of_tilted(target, plain(rng, 0.01), rotation_from_rpy({roll_rad, pitch_rad, 0.0}));
    for (const Dof dof : {Dof::x, Dof::y, Dof::yaw}) {
      EXPECT_EQ(word_of(covariance, dof), kUnobservable) << i;
    }
    for (const Dof dof : {Dof::roll, Dof::pitch, Dof::z}) {
      EXPECT_EQ(word_of(covariance, dof), kDetermined) << i;
    }
  }
}

TEST(CovarianceStep, ACorridorHoldsNeitherXNorYIfItGoesBetweenThem) {
  Rng rng = test::test_rng(6);
  for (const double yaw_deg : {30.0, 45.0, -60.0}) {
    const Points target = corridor(rng, 0.005);
    const PoseCovariance covariance =
        of_tilted(target, corridor(rng, 0.005),
                  rotation_from_rpy({0.0, rad_from_deg(3.0), rad_from_deg(yaw_deg)}));
    for (const Dof dof : {Dof::x, Dof::y}) EXPECT_NE(word_of(covariance, dof), kDetermined);
    for (const Dof dof : {Dof::roll, Dof::pitch, Dof::yaw, Dof::z}) {
      EXPECT_EQ(word_of(covariance, dof), kDetermined) << yaw_deg;
    }
  }
}

/// A LiDAR and the noise of its points.
struct RingSensor {
  RigidTransform T_world_sensor;
  double noise_along_m, noise_across_m;  ///< Along the rays and across the plain.
};

/// What it sees, with 32 rings, of the plain z = -2 m: in its own frame, at most 0.1 m dense.
Points rings_on_plain(Rng& rng, const RingSensor& sensor) {
  const RigidTransform& T = sensor.T_world_sensor;
  PointCloud seen;
  for (int ring = 0; ring < 32; ++ring) {
    const double up = rad_from_deg(-30.0 + 42.0 * ring / 31.0);
    for (int i = 0; i < 720; ++i) {
      const double azimuth = rad_from_deg(0.5 * i);
      const Eigen::Vector3d ray =
          T.rotation * Eigen::Vector3d(std::cos(up) * std::cos(azimuth),
                                       std::cos(up) * std::sin(azimuth), std::sin(up));
      const double distance_m = (-2.0 - T.translation.z()) / ray.z();
      if (!(ray.z() < 0.0) || distance_m > 100.0) continue;
      Eigen::Vector3d point =
          T.translation + (distance_m + sensor.noise_along_m * rng.normal()) * ray;
      point.z() += sensor.noise_across_m * rng.normal();
      seen.points.push_back((T.inverse() * point).cast<float>());
    }
  }
  return test::stage<Preprocessor>(R"({"type": "voxel_downsample"})")->apply(seen).points;
}

/// The words of a sensor in front of the reference, both on the plain, with this noise.
PoseCovariance of_rings(Rng& rng, double noise_along_m, double noise_across_m,
                        const std::string& parameters = "") {
  const RigidTransform pose{rotation_from_rpy({0.0, rad_from_deg(10.0), rad_from_deg(3.0)}),
                            {2.0, 0.1, -1.0}};
  const Points target = rings_on_plain(rng, {{}, noise_along_m, noise_across_m});
  const Points source = rings_on_plain(rng, {pose, noise_along_m, noise_across_m});
  return *judged(test::estimate_of(target, source, pose), parameters).covariance;
}

TEST(CovarianceStep, RingsOnAPlainDoNotHoldXYAndYaw) {
  Rng rng = test::test_rng(9);
  for (int i = 0; i < 8; ++i) {
    // On a far ring the noise turns the normals of both clouds alike, as if a wall stood there.
    const PoseCovariance covariance =
        i % 2 == 0 ? of_rings(rng, 0.02, 0.0) : of_rings(rng, 0.0, 0.007);
    for (const Dof dof : {Dof::x, Dof::y, Dof::yaw}) {
      EXPECT_EQ(word_of(covariance, dof), kUnobservable) << i;
    }
    for (const Dof dof : {Dof::roll, Dof::pitch, Dof::z}) {
      EXPECT_NE(word_of(covariance, dof), kUnobservable) << i;
    }
  }
}

TEST(CovarianceStep, NormalsOnRingsPretendToHoldAPlain) {
  Rng rng = test::test_rng(9);
  int held = 0;
  for (int i = 0; i < 4; ++i) {
    const PoseCovariance covariance = of_rings(rng, 0.0, 0.007, R"(, "line_breadth_ratio": 0)");
    for (const Dof dof : {Dof::x, Dof::y}) held += word_of(covariance, dof) != kUnobservable;
  }
  EXPECT_GT(held, 0);
}

TEST(CovarianceStep, RingsWithoutNoiseCount) {
  Rng rng = test::test_rng(10);
  const PoseCovariance covariance = of_rings(rng, 0.0, 0.0);
  for (const Dof dof : {Dof::roll, Dof::pitch, Dof::z}) {
    EXPECT_EQ(word_of(covariance, dof), kDetermined);
  }
}

/// The clouds of a simulated scene of this kind, at the truth.
std::vector<Estimate> simulated_estimates(const std::string& kind, int scenes) {
  const auto dataset = test::stage<Dataset>(
      R"({"type": "simulated", "rig": "croon_three", "noise": "real_still", "scenes": )" +
      std::to_string(scenes) + R"(, "mix": {")" + kind + R"(": 1}})");
  const auto thinning = test::stage<Preprocessor>(R"({"type": "voxel_downsample"})");
  std::vector<Estimate> estimates;
  for (const Scene& scene : dataset->scenes("nowhere")) {
    const PointCloud target = thinning->apply(scene.reference.load());
    for (const SensorScan& scan : scene.sensors) {
      const PointCloud source = thinning->apply(scan.load());
      estimates.push_back(test::estimate_of(target.points, source.points, *scan.truth));
    }
  }
  return estimates;
}

TEST(CovarianceStep, AnEmptySceneDoesNotHoldXYAndYaw) {
  for (const Estimate& estimate : simulated_estimates("empty", 2)) {
    const PoseCovariance covariance = *judged(estimate).covariance;
    for (const Dof dof : {Dof::x, Dof::y, Dof::yaw}) {
      EXPECT_EQ(word_of(covariance, dof), kUnobservable);
    }
  }
}

TEST(CovarianceStep, ASimulatedCorridorDoesNotHoldItsAxis) {
  for (const Estimate& estimate : simulated_estimates("corridor", 6)) {
    const PoseCovariance covariance = *judged(estimate).covariance;
    EXPECT_NE(word_of(covariance, Dof::x), kDetermined);
    EXPECT_NE(word_of(covariance, Dof::yaw), kUnobservable);
    // That x is not held must not hide what the walls hold.
    EXPECT_LT(std_of(covariance, Dof::yaw), rad_from_deg(2.0));
    EXPECT_LT(std_of(covariance, Dof::y), 0.5);
  }
}

TEST(CovarianceStep, AnUnknownVelocityAddsToTheDirectionOfTravel) {
  Rng rng = test::test_rng(8);
  const test::StreetPair pair =
      test::street_pair(rng, 3, test::random_pose(rng, 0.5), 20000, 12000, 0.01);
  const auto timed = [](const Points& points, double time_s) {
    PointCloud cloud(points);
    cloud.channels.push_back(make_channel(kTime, std::vector<double>(points.size(), time_s)));
    return std::make_shared<const Cloud>(std::move(cloud), StreamKey(1));
  };
  Estimate estimate = test::estimate_of(pair.target, pair.source, pair.T_target_source);
  const PoseCovariance known = *judged(estimate).covariance;
  const std::string unknown = R"(, "velocity_std_mps": [2, 0, 0])";
  EXPECT_THROW(judged(estimate, unknown), StageError);  // No channel.
  estimate.target = timed(pair.target, 0.0);
  estimate.source = timed(pair.source, 1e9);
  EXPECT_THROW(judged(estimate, unknown), StageError);  // Another zero.
  estimate.source = timed(pair.source, 0.05);
  // The whole source is 50 ms later, so the pose is off by as much as the car moves.
  const PoseCovariance driving = *judged(estimate, unknown).covariance;
  // A step that estimated the velocity says how well.
  Estimate corrected = estimate;
  corrected.extras.put(kMotionCovariance,
                       Matrix6d((2.0 * Vector6d::Unit(3)).cwiseAbs2().asDiagonal()));
  EXPECT_EQ(judged(corrected).covariance->matrix, driving.matrix);
  const double added = driving.matrix(3, 3) - known.matrix(3, 3);
  EXPECT_NEAR(std::sqrt(added), 0.1, 0.01);
  EXPECT_NEAR(std_of(driving, Dof::z), std_of(known, Dof::z), 0.003);
}

TEST(CovarianceStep, OfCloudsThatDoNotTouchNothingIsKnown) {
  Rng rng = test::test_rng(5);
  RigidTransform far;
  far.translation.z() = 100.0;
  const Points target = plain(rng, 0.0);
  const auto covariance = *judged(test::estimate_of(target, plain(rng, 0.0), far)).covariance;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(covariance.dofs.at(k), kUnobservable);
    EXPECT_EQ(std_of(covariance, static_cast<Dof>(k)), k < 3 ? kUnknown_rad : kUnknown_m);
  }
}

TEST(CovarianceStep, IsAboutAsLargeAsTheErrorsOfTheRegistration) {
  Rng rng = test::test_rng(6);
  const auto icp = test::stage<Icp>(
      R"({"type": "gicp", "normal_neighbours": 10, "direction_balance": 0.5,
          "max_distances_m": [0.3], "kernel_width_m": 0.05})");
  double sum = 0.0;
  constexpr int kStreets = 8;
  for (std::uint64_t i = 0; i < kStreets; ++i) {
    const test::StreetPair pair =
        test::street_pair(rng, 100 + i, test::random_pose(rng, 0.5), 20000, 12000, 0.01);
    Estimate estimate = test::estimate_of(pair.target, pair.source, pair.T_target_source);
    estimate.T_target_source =
        icp->align(*estimate.target, *estimate.source, pair.T_target_source).T_target_source;
    const Vector6d error = pose_error(estimate.T_target_source, pair.T_target_source).dof;
    const Estimate after = judged(estimate);
    for (int k = 0; k < 6; ++k) {
      sum += error(k) * error(k) / after.covariance->matrix(k, k) / (6.0 * kStreets);
    }
  }
  EXPECT_GT(sum, 0.25);
  EXPECT_LT(sum, 3.0);
}

TEST(Covariance, RefusesBoundsInTheWrongOrder) {
  EXPECT_EQ(test::input_error(
                [] { test::build_stage("step", R"({"step": "covariance", "weak_ratio": 1})"); }),
            "test: /: unobservable_ratio must not be above weak_ratio, found weak_ratio 1 and "
            "unobservable_ratio 2");
}

}  // namespace
}  // namespace croon
