#pragma once

#include "framework/registration/joint_registration.hpp"

namespace croon {

/// The target of a scene with its points where they were at the reference time.
class StillTarget {
 public:
  StillTarget(const JointScene& scene, const Twist& velocity, int normal_neighbours);

  const Cloud& cloud() const { return cloud_; }
  const Normals& normals() const { return normals_; }
  /// When point `index` was measured, from the reference time on.
  double time_s(int index) const { return scene_.target.times_s[index] - scene_.reference_s; }

 private:
  const JointScene& scene_;
  Cloud cloud_;
  const Normals& normals_;
};

/// The unknowns of one pair of clouds: its pose (Dof), the velocity (about the axes, along them),
/// and the offset of the sensor's clock. Each begins here.
inline constexpr int kPairPose = 0;
inline constexpr int kPairVelocity = 6;
inline constexpr int kPairOffset = 12;
inline constexpr int kPairUnknowns = 13;

/// The sums of Gauss-Newton over the correspondences of one pair of clouds, see NormalEquations.
struct PairEquations {
  Eigen::Matrix<double, kPairUnknowns, kPairUnknowns> information =
      Eigen::Matrix<double, kPairUnknowns, kPairUnknowns>::Zero();
  Eigen::Matrix<double, kPairUnknowns, 1> gradient =
      Eigen::Matrix<double, kPairUnknowns, 1>::Zero();
  double weighted_square_sum = 0.0;
  double weight_sum = 0.0;
  int correspondences = 0;
};

/// The sums for one source of a scene at `state`, with the velocity of that scene.
PairEquations pair_equations(const JointScene::Source& source, const StillTarget& target,
                             double reference_s, const Twist& velocity, const JointState& state,
                             double max_distance_m, const JointOptions& options);

}  // namespace croon
