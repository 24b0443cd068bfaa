#include "framework/registration/plane_cost.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace croon {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

PointSums joined(const PlanePatch& patch, const std::vector<RigidTransform>& poses) {
  PointSums all;
  for (const PlanePatch::View& view : patch.views) {
    const PointSums part = moved(view.sums, poses[view.sensor]);
    all.weight += part.weight;
    all.sum += part.sum;
    all.products += part.products;
  }
  return all;
}

}  // namespace

void PointSums::add(const Eigen::Vector3d& point) {
  weight += 1.0;
  sum += point;
  products.noalias() += point * point.transpose();
}

PointSums PointSums::scaled(double factor) const {
  return {factor * weight, factor * sum, factor * products};
}

Eigen::Matrix3d PointSums::scatter() const {
  if (!(weight > 0.0)) return Eigen::Matrix3d::Zero();
  return products - sum * (sum / weight).transpose();
}

PointSums moved(const PointSums& sums, const RigidTransform& T) {
  const Eigen::Vector3d arm = T.rotation * sums.sum;
  const Eigen::Matrix3d mixed = arm * T.translation.transpose();
  PointSums after;
  after.weight = sums.weight;
  after.sum = arm + sums.weight * T.translation;
  after.products = T.rotation * sums.products * T.rotation.transpose() + mixed + mixed.transpose() +
                   sums.weight * T.translation * T.translation.transpose();
  return after;
}

double least_eigenvalue(const Eigen::Matrix3d& scatter) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter, Eigen::EigenvaluesOnly);
  return std::max(solver.eigenvalues()(0), 0.0);
}

double plane_cost_value(const PlanePatch& patch, const std::vector<RigidTransform>& poses) {
  return std::max(least_eigenvalue(joined(patch, poses).scatter()) - patch.own_cost, 0.0);
}

void plane_cost(const PlanePatch& patch, const std::vector<RigidTransform>& poses,
                PlaneCost& cost) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  const PointSums all = joined(patch, poses);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(all.scatter());
  const Vector3d& variances = solver.eigenvalues();
  const double least = std::max(variances(0), 0.0);
  const Vector3d n = solver.eigenvectors().col(0);
  cost.value = std::max(least - patch.own_cost, 0.0);
  cost.normal = n;
  cost.centre = all.sum / all.weight;
  cost.views.assign(patch.views.size(), {});
  // The plane turns about the two other eigenvectors and moves along n. The second derivatives by
  // these three are 2 (l_1 - l_0), 2 (l_2 - l_0) and 2 w; they do not mix.
  const double smallest_gap = 1e-12 * variances(2) + 1e-300;
  const Vector3d curvature =
      2.0 * Vector3d(std::max(variances(1) - least, smallest_gap),
                     std::max(variances(2) - least, smallest_gap), all.weight);
  const Matrix3d N = cross_matrix(n);
  for (std::size_t k = 0; k < patch.views.size(); ++k) {
    const PointSums& sums = patch.views[k].sums;
    const RigidTransform& T = poses[patch.views[k].sensor];
    PlaneCost::View& view = cost.views[k];
    // With arms a = R s and offsets o = a + t - c: sums of a, o, a a^T and a o^T.
    const Vector3d shift = T.translation - cost.centre;
    const Vector3d arm = T.rotation * sums.sum;
    const Vector3d offset = arm + sums.weight * shift;
    const Matrix3d arms = T.rotation * sums.products * T.rotation.transpose();
    const Matrix3d mixed = arms + arm * shift.transpose();
    // A point moves by (turn x a + d), its distance r = n . o by the row j = ((a x n)^T, n^T).
    const Vector3d arm_distance = mixed * n;  // sum of a r
    const double distance = offset.dot(n);    // sum of r
    view.gradient << 2.0 * arm_distance.cross(n), 2.0 * distance * n;
    Matrix3d bend = n * arm_distance.transpose();  // The second derivative of a turned arm.
    bend = 0.5 * (bend + bend.transpose()).eval();
    bend.diagonal().array() -= n.dot(arm_distance);
    const Vector3d turned = -(N * arm);
    view.direct.topLeftCorner<3, 3>() = 2.0 * (N * arms * N.transpose() + bend);
    view.direct.topRightCorner<3, 3>() = 2.0 * turned * n.transpose();
    view.direct.bottomLeftCorner<3, 3>() = 2.0 * n * turned.transpose();
    view.direct.bottomRightCorner<3, 3>() = 2.0 * sums.weight * n * n.transpose();
    for (int i = 0; i < 2; ++i) {
      const Vector3d q = solver.eigenvectors().col(i + 1);
      view.to_plane.col(i) << 2.0 * (arm_distance.cross(q) - N * (mixed * q)),
          2.0 * (distance * q + n * offset.dot(q));
    }
    view.to_plane.col(2) << 2.0 * turned, 2.0 * sums.weight * n;
    view.to_plane *= curvature.cwiseSqrt().cwiseInverse().asDiagonal();
  }
}

}  // namespace croon
