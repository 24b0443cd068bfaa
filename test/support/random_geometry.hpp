#pragma once

#include "framework/base/rng.hpp"
#include "framework/geometry/point_cloud.hpp"
#include "framework/geometry/pose_covariance.hpp"

namespace croon::test {

/// A generator for a test; `seed` makes several of them.
Rng test_rng(std::uint64_t seed = 1);

/// A pose with a rotation uniform on SO(3) and a translation within +-`extent_m`.
RigidTransform random_pose(Rng& rng, double extent_m);

/// A pose within +-`rotation_deg` per axis and +-`translation_m` per axis of `pose`, as a start is
/// drawn.
RigidTransform pose_near(Rng& rng, const RigidTransform& pose, double rotation_deg,
                         double translation_m);

/// A vector as errors of poses are: rotations of about 0.01 rad, translations of about 0.1 m.
Vector6d pose_vector(Rng& rng);

/// A covariance of such errors, with words drawn at random.
PoseCovariance random_covariance(Rng& rng);

/// A point uniform in a cube of +-`extent_m`.
Eigen::Vector3d random_point(Rng& rng, double extent_m);

/// `count` such points.
Points random_cloud(Rng& rng, int count, double extent_m);

/// A street as a LiDAR 2 m above it may see it, 20 m around: ground, two house fronts along x with
/// protrusions, boxes and poles. `count` points, uniform over the surfaces, with `noise_m` of
/// normal noise. Two calls with the same `scene_seed` sample the same street at different points.
Points random_street(Rng& rng, std::uint64_t scene_seed, int count, double noise_m);

/// One street seen by two sensors.
struct StreetPair {
  RigidTransform T_target_source;  ///< The truth.
  Points target;                   ///< In the target's frame.
  Points source;                   ///< In the source's frame.
};

/// The street `scene_seed` (see random_street) seen by two sensors, each at other points.
/// `T_target_street` is the pose of the street in the target's frame.
StreetPair street_pair(Rng& rng, std::uint64_t scene_seed, const RigidTransform& T_target_source,
                       int target_count, int source_count, double noise_m,
                       const RigidTransform& T_target_street = {});

/// `points` as a LiDAR measures them: with the channels intensity (1 to 100), ring and time.
PointCloud measured(const Points& points);

}  // namespace croon::test
