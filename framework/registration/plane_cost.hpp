#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/registration/block_system.hpp"

namespace croon {

/// The sums over points of one sensor, in its frame (m, m^2), from which their distances to any
/// plane can be computed.
struct PointSums {
  double weight = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& point, double point_weight = 1.0);
  /// Adds the points of `other`, in the same frame.
  void add(const PointSums& other);
  /// The sums with all weights times `factor`.
  PointSums scaled(double factor) const;
  /// `sum w (p - c)(p - c)^T` around the mean c, m^2; zero without points.
  Eigen::Matrix3d scatter() const;
};

/// The sums of the same points after the motion `T`.
PointSums moved(const PointSums& sums, const RigidTransform& T);

/// The minimum eigenvalue of a scatter, clamped to zero: the weighted sum of squared distances to
/// the best-fitting plane.
double min_eigenvalue(const Eigen::Matrix3d& scatter);

/// A piece of a plane that several sensors see, the sensors in ascending order.
struct PlanePatch {
  struct View {
    std::size_t sensor = 0;
    PointSums sums;
    /// The same with each weight multiplied by the point's time, s, and by its square; zero if the
    /// times are unknown.
    PointSums timed = {};
    PointSums timed_twice = {};
  };
  std::vector<View> views;
  /// The cost of separate planes for all sensors; a lower bound for any poses.
  double own_cost = 0.0;
};

/// The poses and velocity of a rig's sensors in a common frame.
struct RigState {
  std::vector<RigidTransform> poses;  ///< T_common_sensor, by sensor.
  /// If the rig moves while scanning: the difference of the common frame's velocity from the one
  /// for which the points were corrected to time zero. A point p moves by t (u + w x p).
  std::optional<Twist> velocity = std::nullopt;
};

/// The cost of a patch and its derivatives. With the normal `n` and the mean `c` of all its points,
/// the cost is `min over planes of sum w (n . (p - c))^2`, the minimum eigenvalue of the scatter,
/// minus PlanePatch::own_cost. The plane is eliminated in closed form (BALM: Liu and Zhang, RA-L
/// 2021; Liu, Liu and Zhang, T-RO 2023).
struct PlaneCost {
  /// The part of one six-dimensional unknown: the pose of a view's sensor, as a rotation about its
  /// own origin from the left (rad) and a translation (m), in the order of Dof; or the velocity.
  /// The Hessian with respect to two unknowns a and b is `mixed_ab - to_plane_a to_plane_b^T`,
  /// where mixed_ab is non-zero only if a = b (`direct`), and for a pose and the velocity.
  struct Part {
    Vector6d gradient = Vector6d::Zero();
    Matrix6d direct = Matrix6d::Zero();
    Eigen::Matrix<double, 6, 3> to_plane = Eigen::Matrix<double, 6, 3>::Zero();
  };
  double value = 0.0;  ///< Not negative.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Part> views;  ///< In the order of PlanePatch::views.
  /// Of the velocity; zero if RigState has none.
  Part velocity;
  std::vector<Matrix6d> view_velocity;  ///< By view: mixed_ab with the velocity.
};

/// The matrix that maps the velocity (w, u) of the common frame, about its axes and along them, to
/// the velocity of a sensor at `origin` in the same axes: `(w, u + w x origin)`.
Matrix6d velocity_at(const Eigen::Vector3d& origin);

/// Only the value of the cost.
double plane_cost_value(const PlanePatch& patch, const RigState& state);

/// The cost with its derivatives, to first order in the velocity. The memory of `cost` is reused.
void plane_cost(const PlanePatch& patch, const RigState& state, PlaneCost& cost);

/// The robust cost of the `patches` of one scene: the sum of `w^2 c / (w^2 + c)` over the costs c
/// of the planes, with the width w of the kernel.
double bundle_value(const std::vector<PlanePatch>& patches, const RigState& state,
                    double kernel_width);

/// The derivatives of bundle_value with respect to the `poses`, by sensor, and then to the
/// velocity, if `state` has one.
BlockSystem bundle_cost(const std::vector<PlanePatch>& patches, const RigState& state,
                        double kernel_width, const std::vector<Block>& poses);

}  // namespace croon
