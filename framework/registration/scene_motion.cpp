#include "framework/registration/scene_motion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "framework/base/text.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/joint_rivals.hpp"

namespace croon {
namespace {

using Cells = std::map<JointCell, CellEquations>;

int correspondences_in(const Cells& cells) {
  int sum = 0;
  for (const auto& [place, sums] : cells) sum += sums.correspondences;
  return sum;
}

/// A linear system whose solution is a step of the velocity.
struct VelocityEquations {
  Matrix6d information;
  Vector6d gradient = Vector6d::Zero();
};

/// The equations of the velocity from the sums of each sensor, with its pose eliminated (Schur
/// complement).
VelocityEquations velocity_equations(const std::vector<CellEquations>& sensors,
                                     const Matrix6d& prior) {
  VelocityEquations equations{prior};
  for (const CellEquations& sums : sensors) {
    const Matrix6d pose = sums.hessian.block<6, 6>(kPairPose, kPairPose);
    const Matrix6d mixed = sums.hessian.block<6, 6>(kPairVelocity, kPairPose);
    const Matrix6d by_pose = mixed * guarded_inverse<6>(pose);
    equations.information += sums.hessian.block<6, 6>(kPairVelocity, kPairVelocity);
    equations.information -= by_pose * mixed.transpose();
    equations.gradient += sums.gradient.segment<6>(kPairVelocity);
    equations.gradient -= by_pose * sums.gradient.segment<6>(kPairPose);
  }
  return equations;
}

/// The covariance of the velocity for which `target` was motion-compensated (about the axes in
/// rad/s, along them in m/s), in the `state` that register_jointly found: the jackknife over cubes
/// of space (see pose_uncertainty), with the poses of the sensors free. Moving objects occupy few
/// cubes, and their speed is not that of the car: where such cubes are decisive, leaving one out
/// changes the velocity. Each scene is judged by itself, even if others share its poses. Limited to
/// the covariance of a velocity without any observations (JointOptions::velocity_std).
Matrix6d velocity_covariance(const DeskewedTarget& target, const JointState& state,
                             const JointOptions& options) {
  const JointScene& scene = target.scene();
  const JointView view = last_view(state, target.velocity(), options);
  std::vector<CellEquations> all(scene.sources.size());
  std::map<JointCell, std::vector<CellEquations>> cells;
  for (std::size_t j = 0; j < scene.sources.size(); ++j) {
    const Cells of_source = cell_equations(scene.sources[j], target, view);
    if (correspondences_in(of_source) < kMinJointCorrespondences) continue;
    for (const auto& [place, sums] : of_source) {
      all[j].hessian += sums.hessian;
      std::vector<CellEquations>& cell = cells[place];
      cell.resize(scene.sources.size());
      cell[j] = sums;
    }
  }
  const Matrix6d prior = velocity_information(scene, options);
  Matrix6d covariance = Matrix6d::Zero();
  if (scene.velocity_covariance) {
    // The error of the prior velocity moves the estimate by its share in it.
    const Matrix6d share = guarded_inverse<6>(velocity_equations(all, prior).information) * prior;
    covariance = share * *scene.velocity_covariance * share.transpose();
  }
  for (auto& [place, cell] : cells) {
    for (std::size_t j = 0; j < cell.size(); ++j)
      cell[j].hessian = all[j].hessian - cell[j].hessian;
    const auto [information, gradient] = velocity_equations(cell, prior);
    const Vector6d step = guarded_inverse<6>(information) * gradient;
    covariance += step * step.transpose();
  }
  // No velocity is less certain than one without any observations.
  const double width_m = options.kernel_width_m;
  const Matrix6d of_unknown = unknown_velocity_information(options) / (width_m * width_m);
  return guarded_inverse<6>(guarded_inverse<6>(covariance) + of_unknown);
}

}  // namespace

const params::Table<MotionOptions>& motion_table() {
  static const params::Table<MotionOptions> table = {
      params::number("min_motion", &MotionOptions::min_motion, {0.0, 1e9},
                     "Minimum squared Mahalanobis distance of a velocity from zero for a scene to "
                     "count as moving; for stationary cars it was 6 to 67 on tuning scenes."),
      params::number(
          "max_speed_std_mps", &MotionOptions::max_speed_std_mps, {0.0, 1e6},
          "Maximum standard deviation of a certain speed along x and y of the reference. "
          "With one pose per scene, a scene with a less certain speed is compared with "
          "other speeds, because independently moving objects may be mistaken for "
          "static ones.")
          .formerly("certain_speed_std_mps"),
      params::numbers("other_speeds_mps", &MotionOptions::other_speeds_mps, {-1e3, 1e3},
                      "Alternative forward speeds along the dominant axis of motion."),
      params::number(
          "min_speed_lead", &MotionOptions::min_speed_lead, {-1e3, 1e3},
          "Minimum lead of the agreement of points, in standard deviations, for a sensor of such a "
          "scene to be accepted: over every rival in which the sensor is more than " +
              fixed_number(kRivalDistance_m, 2) +
              " m away, i.e. the results from these speeds and the state without the patch "
              "kernel; cubes of " +
              fixed_number(kJointCell_m, 0) + " m count as independent."),
      params::number("certain_shift_m", &MotionOptions::certain_shift_m, {0.0, 1e6},
                     "If the uncertainty of the velocity shifts a sensor by at most this, e.g. "
                     "because it sees objects at the same time as the reference, the minimum lead "
                     "is 0, or min_speed_lead if that is below 0."),
  };
  return table;
}

double speed_std_mps(const Matrix6d& covariance) {
  return std::sqrt(covariance(3, 3) + covariance(4, 4));
}

bool SceneMotion::is_in_doubt(const MotionOptions& options) const {
  return speed_std_mps(covariance) > options.max_speed_std_mps;
}

std::string SceneMotion::rejection(std::size_t source, const MotionOptions& options) const {
  const bool is_shift_certain = shift_std_m.at(source) <= options.certain_shift_m;
  const double min_lead =
      is_shift_certain ? std::min(options.min_speed_lead, 0.0) : options.min_speed_lead;
  const std::optional<double>& lead = leads.at(source);
  if (!lead || *lead >= min_lead) return "";
  return "the standard deviation of the speed, m/s, is " +
         fixed_number(speed_std_mps(covariance), 3) +
         ", and the lead over another speed, in standard deviations, is " + fixed_number(*lead, 2) +
         ", below " + fixed_number(min_lead, 2);
}

std::vector<double> shift_std_m(const DeskewedTarget& target, const Matrix6d& covariance,
                                const JointState& state, const JointOptions& options) {
  const JointView view = last_view(state, target.velocity(), options);
  std::vector<double> std_m;
  for (const JointScene::Source& source : target.scene().sources) {
    const PairMatrix information = pair_equations(source, target, view).information;
    // After a change of the velocity, the residuals are minimal at another pose.
    const Matrix6d pose_by_velocity =
        -guarded_inverse<6>(information.block<6, 6>(kPairPose, kPairPose)) *
        information.block<6, 6>(kPairPose, kPairVelocity);
    const Eigen::Matrix<double, 3, 6> shift = pose_by_velocity.bottomRows<3>();
    std_m.push_back(std::sqrt(std::max(0.0, (shift * covariance * shift.transpose()).trace())));
  }
  return std_m;
}

SceneMotion motion_of(const JointScene& scene, std::size_t s, const JointState& state,
                      const std::optional<JointState>& state_without_patch_kernel,
                      const JointOptions& options, const MotionOptions& motion_options) {
  SceneMotion motion;
  motion.shift_std_m.assign(scene.sources.size(), 0.0);
  motion.leads.resize(scene.sources.size());
  if (!scene.is_moving) return motion;
  const Vector6d velocity = vector_of(state.velocities[s]);
  const DeskewedTarget target(scene, state.velocities[s], options);
  motion.covariance = velocity_covariance(target, state, options);
  if (state_without_patch_kernel) {
    const Vector6d apart = velocity - vector_of(state_without_patch_kernel->velocities[s]);
    motion.covariance += apart * apart.transpose();
  }
  motion.shift_std_m = shift_std_m(target, motion.covariance, state, options);
  // The error of a prior velocity need not be zero.
  motion.is_moving =
      scene.velocity_covariance.has_value() ||
      velocity.dot(guarded_inverse<6>(motion.covariance) * velocity) >= motion_options.min_motion;
  if (motion.is_moving) motion.velocity = state.velocities[s];
  return motion;
}

Eigen::Vector3d axis_of_motion(const SceneMotion& motion, const Twist& velocity) {
  const Eigen::Vector2d mean_mps = velocity.linear_mps.head<2>();
  const Eigen::Matrix2d second_moment =
      motion.covariance.block<2, 2>(3, 3) + mean_mps * mean_mps.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(second_moment);
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis.head<2>() = axes.eigenvectors().col(1);
  const double forwards = axis.dot(velocity.linear_mps);
  if (forwards < 0.0 || (forwards == 0.0 && axis.x() < 0.0)) axis = -axis;
  return axis;
}

}  // namespace croon
