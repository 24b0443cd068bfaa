#include "framework/geometry/plane.hpp"

#include <Eigen/Eigenvalues>

#include "framework/base/error.hpp"

namespace croon {

Plane fit_plane(const PointCloud& cloud, const std::vector<int>& indices) {
  if (indices.size() < 3) throw StageError("a plane needs three points");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : indices) mean += cloud[i].cast<double>();
  mean /= static_cast<double>(indices.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int i : indices) {
    const Eigen::Vector3d offset = cloud[i].cast<double>() - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d variances = solver.eigenvalues();
  if (!(variances(1) > 1e-12 * variances(2))) throw StageError("the points lie on one line");
  const Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  return {normal, -normal.dot(mean)};
}

}  // namespace croon
