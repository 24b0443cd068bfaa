#include "framework/registration/bundle_observability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/observability.hpp"

namespace croon {
namespace {

/// The information of planes about the pose of a sensor, and the part due to noisy normals.
struct PlaneEvidence {
  Matrix6d information = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();
};

/// Adds the information of a patch about each of its sensors, with the others fixed.
void add_patch(const PlanePatch& patch, const std::vector<RigidTransform>& poses,
               std::vector<PlaneEvidence>& evidence) {
  PointSums all;
  for (const PlanePatch::View& view : patch.views) {
    all.add(moved(view.sums, poses[view.sensor]));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(all.scatter());
  const Eigen::Vector3d& across = solver.eigenvalues();
  for (const PlanePatch::View& view : patch.views) {
    const double own = view.sums.weight, others = all.weight - own;
    if (!(own > 0.0) || !(others > 0.0)) continue;
    // The variance of the distance between two planes is the sum of their variances.
    const double weight = own * others / all.weight;
    const Eigen::Vector3d arm = poses[view.sensor].rotation * (view.sums.sum / own);
    const Vector6d J = plane_jacobian(arm, solver.eigenvectors().col(0));
    PlaneEvidence& of_sensor = evidence[view.sensor];
    of_sensor.information += weight * (J * J.transpose());
    for (int k = 1; k < 3; ++k) {
      // The weights are inverse variances, so this is the variance of a turn towards the axis k.
      const double turn = 1.0 / std::max(across(k) - across(0), 1e-12);
      const Vector6d turned = plane_jacobian(arm, solver.eigenvectors().col(k));
      of_sensor.noise += weight * turn * (turned * turned.transpose());
    }
  }
}

}  // namespace

std::vector<DofObservability> plane_observability(const BundleSystem& system) {
  const std::size_t sensors = system.state().poses.size();
  std::vector<PlaneEvidence> evidence(sensors);
  for (std::size_t s = 0; s < system.planes().size(); ++s) {
    const std::vector<RigidTransform> poses = system.rig_state(system.state(), s).poses;
    for (const PlanePatch& patch : system.planes()[s]) add_patch(patch, poses, evidence);
  }
  const Matrix6d prior = unknown_variances().cwiseInverse().asDiagonal();
  std::vector<DofObservability> words(sensors);  // Initially all determined.
  for (std::size_t k = 1; k < sensors; ++k) {
    const auto held = dof_constraints(evidence[k].information, evidence[k].noise, prior);
    for (std::size_t dof = 0; dof < held.size(); ++dof) words[k][dof] = held[dof].word;
  }
  return words;
}

}  // namespace croon
