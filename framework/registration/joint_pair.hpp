#pragma once

#include <map>
#include <memory>
#include <optional>

#include "framework/registration/joint_registration.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// The target of a scene with its points moved to where they were at the reference time.
class DeskewedTarget {
 public:
  DeskewedTarget(const JointScene& scene, const Twist& velocity, const JointOptions& options);

  /// Moves the points for another velocity. The kd-tree is rebuilt if, to first order, a point may
  /// be farther than `max_shift_m` from its position in the tree.
  void set_velocity(const Twist& velocity, double max_shift_m);

  const JointScene& scene() const { return scene_; }
  const Twist& velocity() const { return velocity_; }
  /// The point nearest to `query`, using the positions in the tree, which are as if the scan had
  /// been measured in kSteps steps.
  Neighbour nearest(const Eigen::Vector3d& query, double max_distance_m) const;
  /// A point at the reference time and its unit normal there, zero if it has none: the normal of
  /// the scan as measured, rotated with the point, because a point's neighbours were measured at
  /// about the same time.
  struct Surface {
    Eigen::Vector3d point, normal;
  };
  Surface surface(int index) const;
  /// The measurement time of point `index`, relative to the reference time.
  double time_s(int index) const { return scene_.target.times_s[index] - scene_.reference_s; }
  double reference_s() const { return scene_.reference_s; }
  /// 1, or JointOptions::vehicle_weight if point `index` belongs to a vehicle-sized object.
  double weight(int index) const {
    return vehicles_ && (*vehicles_)[index] ? vehicle_weight_ : 1.0;
  }

 private:
  static constexpr int kSteps = 1024;

  void move_tree();

  const JointScene& scene_;
  Twist velocity_;
  Twist tree_velocity_;  ///< For which the points in the tree were moved.
  /// Not in a Cloud: computations for one velocity are work of the trial, not shared work.
  std::unique_ptr<KdTree> moved_tree_;
  Points moved_points_;
  const KdTree* tree_;                    ///< Of the moved points, or the shared one of the scan.
  const Normals& normals_;                ///< Of the scan as measured.
  TimeSpan span_;                         ///< Of the times of all points.
  double max_time_s_ = 0.0;               ///< Maximum time from the reference time.
  double max_time_times_range_sm_ = 0.0;  ///< Maximum product of that time and a point's range.
  double vehicle_weight_;
  /// Whether each point belongs to a vehicle-sized object; null if all points weigh the same.
  std::shared_ptr<const std::vector<bool>> vehicles_;
};

/// The unknowns of one pair of clouds: its pose (Dof), the velocity (about the axes, along them),
/// and the offset of the sensor's clock. The constants are their first indices.
inline constexpr int kPairPose = 0;
inline constexpr int kPairVelocity = 6;
inline constexpr int kPairOffset = 12;
inline constexpr int kPairUnknowns = 13;
using PairVector = Eigen::Matrix<double, kPairUnknowns, 1>;
using PairMatrix = Eigen::Matrix<double, kPairUnknowns, kPairUnknowns>;

/// The prior information about the velocity of a scene, relative to residuals of the kernel's
/// width: about the axes, along them. Standard deviations below 0.1 mm/s and 0.1 mrad/s are raised
/// to these.
Matrix6d velocity_information(const JointScene& scene, const JointOptions& options);

/// The same without a velocity from an earlier step.
Matrix6d unknown_velocity_information(const JointOptions& options);

/// The state at which the points of a scene are compared, and the conditions for correspondences.
struct JointView {
  const JointState& state;
  const Twist& velocity;  ///< Of the scene.
  double max_distance_m;
  const JointOptions& options;
};

/// The view of the last pass.
JointView last_view(const JointState& state, const Twist& velocity, const JointOptions& options);

/// The sums of Gauss-Newton over the correspondences of one pair of clouds, see NormalEquations.
struct PairEquations {
  PairMatrix information = PairMatrix::Zero();
  PairVector gradient = PairVector::Zero();
  double weighted_square_sum = 0.0;
  double weight_sum = 0.0;
  int correspondences = 0;
};

PairEquations pair_equations(const JointScene::Source& source, const DeskewedTarget& target,
                             const JointView& view);

/// A cube of space around the target.
using JointCell = LeafKey;

/// The edge of a cube. A car extends over only a few of them.
inline constexpr double kJointCell_m = 6.0;

/// How well one pair of clouds fits, by the points that correspond.
struct PairAgreement {
  struct Point {
    JointCell cell;
    Eigen::Vector3d normal;  ///< Of the target's surface.
    /// The weight times `1 / (1 + r^2 / width^2) - 1/2` for the residual r: a point farther from
    /// the surface than the kernel's width is evidence against the pose. Without the patch kernel.
    double agreeing = 0.0;
  };
  std::vector<Point> points;
  double later_s = 0.0;  ///< Mean time of the sensor's measurements after the target's.

  /// The sums by cube. With an axis, a point is weighted by `|n . axis|` for the normal n of its
  /// surface: a surface parallel to the axis cannot distinguish poses along it.
  std::map<JointCell, double> by_cell(
      const std::optional<Eigen::Vector3d>& axis = std::nullopt) const;
};

PairAgreement pair_agreement(const JointScene::Source& source, const DeskewedTarget& target,
                             const JointView& view);

/// The contributions of the correspondences in one cube to the cost's gradient and Hessian, which
/// includes the curvature of the robust kernel.
struct CellEquations {
  PairMatrix hessian = PairMatrix::Zero();
  PairVector gradient = PairVector::Zero();
  int correspondences = 0;
};

/// The same correspondences by cube. Throws StageError for points outside the grid of cubes.
std::map<JointCell, CellEquations> cell_equations(const JointScene::Source& source,
                                                  const DeskewedTarget& target,
                                                  const JointView& view);

}  // namespace croon
