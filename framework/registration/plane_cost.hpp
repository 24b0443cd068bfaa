#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon {

/// The sums over points of one sensor, in its frame (m, m^2): all that the distances of the points
/// to any plane follow from.
struct PointSums {
  double weight = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& point);
  /// The sums with all weights times `factor`.
  PointSums scaled(double factor) const;
  /// `sum w (p - c)(p - c)^T` around the mean c, m^2; zero without points.
  Eigen::Matrix3d scatter() const;
};

/// The sums of the same points after the motion `T`.
PointSums moved(const PointSums& sums, const RigidTransform& T);

/// The least eigenvalue of a scatter, not below zero: the weighted sum of squared distances to the
/// plane that fits best.
double least_eigenvalue(const Eigen::Matrix3d& scatter);

/// A piece of a plane that several sensors see, the sensors in ascending order.
struct PlanePatch {
  struct View {
    std::size_t sensor = 0;
    PointSums sums;
  };
  std::vector<View> views;
  /// The sum of what each sensor leaves on a plane of its own: no poses make the cost smaller.
  double own_cost = 0.0;
};

/// The cost of a patch at given poses, and its derivatives by the poses. With `n` the normal and
/// `c` the mean of all its points the cost is `min over planes of sum w (n . (p - c))^2`, the least
/// eigenvalue of the scatter, less PlanePatch::own_cost. The plane is eliminated in closed form
/// (BALM: Liu and Zhang, RA-L 2021; Liu, Liu and Zhang, T-RO 2023).
struct PlaneCost {
  /// The part of one view, by the turn about the sensor's own origin from the left (rad) and the
  /// translation (m), in the order of Dof. The Hessian by the views a and b is `(a == b) direct_a -
  /// to_plane_a to_plane_b^T`: the poses are coupled by the plane alone.
  struct View {
    Vector6d gradient = Vector6d::Zero();
    Matrix6d direct = Matrix6d::Zero();
    Eigen::Matrix<double, 6, 3> to_plane = Eigen::Matrix<double, 6, 3>::Zero();
  };
  double value = 0.0;  ///< Not negative.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<View> views;  ///< In the order of PlanePatch::views.
};

/// Only the value of the cost; `T_common_sensor` is by sensor.
double plane_cost_value(const PlanePatch& patch, const std::vector<RigidTransform>& poses);

/// The cost with its derivatives; writes into `cost` to use its memory again.
void plane_cost(const PlanePatch& patch, const std::vector<RigidTransform>& poses, PlaneCost& cost);

}  // namespace croon
