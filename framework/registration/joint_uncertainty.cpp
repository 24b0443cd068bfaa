#include "framework/registration/joint_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "framework/geometry/guarded_inverse.hpp"

namespace croon {
namespace {

using Cells = std::map<JointCell, CellEquations>;

/// The step of the velocity that follows from the sums of each sensor, with its pose free: the
/// Schur complement of the poses.
Vector6d velocity_step(const std::vector<CellEquations>& sensors, const Matrix6d& prior) {
  Matrix6d information = prior;
  Vector6d gradient = Vector6d::Zero();
  for (const CellEquations& sums : sensors) {
    const Matrix6d pose = sums.hessian.block<6, 6>(kPairPose, kPairPose);
    const Matrix6d mixed = sums.hessian.block<6, 6>(kPairVelocity, kPairPose);
    const Matrix6d by_pose = mixed * guarded_inverse<6>(pose);
    information += sums.hessian.block<6, 6>(kPairVelocity, kPairVelocity);
    information -= by_pose * mixed.transpose();
    gradient += sums.gradient.segment<6>(kPairVelocity);
    gradient -= by_pose * sums.gradient.segment<6>(kPairPose);
  }
  return guarded_inverse<6>(information) * gradient;
}

}  // namespace

Matrix6d velocity_covariance(const StillTarget& target, const JointState& state,
                             const JointOptions& options) {
  const JointScene& scene = target.scene();
  const JointView view = last_view(state, target.velocity(), options);
  std::vector<CellEquations> all(scene.sources.size());
  std::map<JointCell, std::vector<CellEquations>> cells;
  for (std::size_t j = 0; j < scene.sources.size(); ++j) {
    const Cells of_source = cell_equations(scene.sources[j], target, view);
    for (const auto& [place, sums] : of_source) {
      all[j].hessian += sums.hessian;
      std::vector<CellEquations>& cell = cells[place];
      cell.resize(scene.sources.size());
      cell[j] = sums;
    }
  }
  const Matrix6d prior = velocity_information(options).asDiagonal();
  Matrix6d covariance = Matrix6d::Zero();
  for (auto& [place, cell] : cells) {
    for (std::size_t j = 0; j < cell.size(); ++j)
      cell[j].hessian = all[j].hessian - cell[j].hessian;
    const Vector6d step = velocity_step(cell, prior);
    covariance += step * step.transpose();
  }
  return covariance;
}

std::vector<double> shift_std_m(const StillTarget& target, const Matrix6d& covariance,
                                const JointState& state, const JointOptions& options) {
  const JointView view = last_view(state, target.velocity(), options);
  std::vector<double> std_m;
  for (const JointScene::Source& source : target.scene().sources) {
    const PairMatrix information = pair_equations(source, target, view).information;
    // A change of the velocity leaves the least residuals at another pose.
    const Matrix6d pose_by_velocity =
        -guarded_inverse<6>(information.block<6, 6>(kPairPose, kPairPose)) *
        information.block<6, 6>(kPairPose, kPairVelocity);
    const Eigen::Matrix<double, 3, 6> shift = pose_by_velocity.bottomRows<3>();
    std_m.push_back(std::sqrt(std::max(0.0, (shift * covariance * shift.transpose()).trace())));
  }
  return std_m;
}

}  // namespace croon
