#pragma once

#include <map>
#include <memory>
#include <optional>

#include "framework/registration/joint_registration.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// The target of a scene with its points where they were at the reference time.
class StillTarget {
 public:
  StillTarget(const JointScene& scene, const Twist& velocity, const JointOptions& options);

  /// Moves the points to another velocity. The tree that finds them is made anew if one of them may
  /// be farther than `max_shift_m` from where the tree has it, to first order.
  void set_velocity(const Twist& velocity, double max_shift_m);

  const JointScene& scene() const { return scene_; }
  const Twist& velocity() const { return velocity_; }
  /// The point that is nearest to `query`, by the places that the tree has.
  Neighbour nearest(const Eigen::Vector3d& query, double max_distance_m) const;
  /// A point where it was at the reference time, and its unit normal there, zero if it has none:
  /// that of the scan as it was measured, turned with the point, because a point's neighbours were
  /// measured at about its time.
  struct Surface {
    Eigen::Vector3d point, normal;
  };
  Surface surface(int index) const;
  /// When point `index` was measured, from the reference time on.
  double time_s(int index) const { return scene_.target.times_s[index] - scene_.reference_s; }
  double reference_s() const { return scene_.reference_s; }
  /// 1, or JointOptions::vehicle_weight if point `index` belongs to a thing of a vehicle's size.
  double weight(int index) const {
    return vehicles_ && (*vehicles_)[index] ? vehicle_weight_ : 1.0;
  }

 private:
  void make_tree();

  const JointScene& scene_;
  Twist velocity_;
  Twist tree_velocity_;  ///< That at which the tree has the points.
  /// Not of a Cloud: what is computed for one velocity alone is work of the trial, not shared work.
  std::unique_ptr<const KdTree> moved_tree_;
  const KdTree* tree_ = nullptr;  ///< Of the points that moved, or that of the scan, shared.
  const Normals& normals_;        ///< Of the scan as it was measured.
  double longest_s_ = 0.0;        ///< The most that a time is from the reference time.
  double widest_sm_ = 0.0;        ///< The most that its product with the point's range is.
  double vehicle_weight_;
  /// Which points belong to things of a vehicle's size; null if they weigh as much as others.
  std::shared_ptr<const std::vector<bool>> vehicles_;
};

/// The unknowns of one pair of clouds: its pose (Dof), the velocity (about the axes, along them),
/// and the offset of the sensor's clock. Each begins here.
inline constexpr int kPairPose = 0;
inline constexpr int kPairVelocity = 6;
inline constexpr int kPairOffset = 12;
inline constexpr int kPairUnknowns = 13;
using PairVector = Eigen::Matrix<double, kPairUnknowns, 1>;
using PairMatrix = Eigen::Matrix<double, kPairUnknowns, kPairUnknowns>;

/// What is expected of the velocity of a scene before any point is seen, as the information of
/// residuals of the kernel's width: about the axes, along them. No standard deviation is taken to
/// be below 0.1 mm/s and 0.1 mrad/s.
Matrix6d velocity_information(const JointScene& scene, const JointOptions& options);

/// The same if no step before has given a velocity.
Matrix6d unknown_velocity_information(const JointOptions& options);

/// Where the points of a scene are compared, and which of them correspond.
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

PairEquations pair_equations(const JointScene::Source& source, const StillTarget& target,
                             const JointView& view);

/// A cube of space around the target.
using JointCell = LeafKey;

/// The edge of a cube. A car is in few of them.
inline constexpr double kJointCell_m = 6.0;

/// How well one pair of clouds fits, by the points that correspond.
struct PairAgreement {
  struct Point {
    JointCell cell;
    Eigen::Vector3d normal;  ///< Of the target's surface.
    /// The weight times `1 / (1 + r^2 / width^2) - 1/2` for the residual r: a point that is farther
    /// than the kernel's width from the surface speaks against the pose. No patch has lost weight.
    double agreeing = 0.0;
  };
  std::vector<Point> points;
  double later_s = 0.0;  ///< So much later than the target the sensor measures, in the mean.

  /// The sums by cubes. With an axis a point counts by `|n . axis|` for the normal n of its
  /// surface: what does not face along it cannot tell poses along it apart.
  std::map<JointCell, double> by_cell(
      const std::optional<Eigen::Vector3d>& axis = std::nullopt) const;
};

PairAgreement pair_agreement(const JointScene::Source& source, const StillTarget& target,
                             const JointView& view);

/// What the correspondences in one cube add to the cost's gradient and Hessian, which has the
/// curvature of the robust kernel.
struct CellEquations {
  PairMatrix hessian = PairMatrix::Zero();
  PairVector gradient = PairVector::Zero();
  int correspondences = 0;
};

/// The same correspondences, by cubes. Throws StageError for points beyond them.
std::map<JointCell, CellEquations> cell_equations(const JointScene::Source& source,
                                                  const StillTarget& target, const JointView& view);

}  // namespace croon
