#include "framework/geometry/plane.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

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

std::vector<int> points_within(const PointCloud& cloud, const Plane& plane, double distance_m) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(plane.signed_distance(cloud[i].cast<double>())) <= distance_m) {
      indices.push_back(static_cast<int>(i));
    }
  }
  return indices;
}

}  // namespace croon
