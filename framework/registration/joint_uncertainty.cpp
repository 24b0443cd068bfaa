#include "framework/registration/joint_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "framework/geometry/guarded_inverse.hpp"

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

}  // namespace

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

}  // namespace croon
