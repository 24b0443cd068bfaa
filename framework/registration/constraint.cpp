#include "framework/registration/constraint.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/registration/gauss_newton.hpp"

namespace croon {
namespace {

struct SurfaceContact {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

std::vector<SurfaceContact> contacts_of(const SensorView& target, const SensorView& source,
                                        const RigidTransform& T, double max_distance_m) {
  const KdTree& tree = target.thinned->kd_tree();
  const Normals& normals = target.thinned->normals(target.normal_neighbours);
  const Normals& source_normals = source.thinned->normals(source.normal_neighbours);
  constexpr double kMinCosine = 0.85;  // Between the normals of surfaces in contact: 32 degrees.
  std::vector<SurfaceContact> contacts;
  for (const int index : source.sample) {
    const Eigen::Vector3d point = T * source.thinned->points()[index].cast<double>();
    const Neighbour nearest = tree.nearest(point.cast<float>(), static_cast<float>(max_distance_m));
    if (!nearest) continue;
    const Eigen::Vector3d normal = normals.at(nearest.index).normal.cast<double>();
    const Eigen::Vector3d other = T.rotation * source_normals.at(index).normal.cast<double>();
    if (std::abs(normal.dot(other)) < kMinCosine) continue;
    contacts.push_back({point, normal});
  }
  return contacts;
}

}  // namespace

std::vector<ConstraintDirection> constraint_directions(const SensorView& target,
                                                       const SensorView& source,
                                                       const RigidTransform& T_target_source,
                                                       double max_distance_m) {
  const std::vector<SurfaceContact> contacts =
      contacts_of(target, source, T_target_source, max_distance_m);
  if (contacts.size() < 6) return {};
  const auto count = static_cast<double>(contacts.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const SurfaceContact& contact : contacts) middle += contact.point / count;
  // Sums over unit motions of the contacts: the part along the normals, and all of it.
  Matrix6d held = Matrix6d::Zero();
  Matrix6d all = 1e-9 * Matrix6d::Identity();
  for (const SurfaceContact& contact : contacts) {
    const Eigen::Matrix<double, 3, 6> J = point_jacobian(contact.point - middle);
    const Vector6d along = J.transpose() * contact.normal;
    held += along * along.transpose() / count;
    all += J.transpose() * J / count;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> solver(held, all);
  std::vector<ConstraintDirection> directions;
  for (int i = 0; i < 6; ++i) {
    const Vector6d motion = solver.eigenvectors().col(i);
    ConstraintDirection direction;
    direction.strength = std::max(0.0, solver.eigenvalues()(i));
    direction.motion.head<3>() = motion.head<3>();
    // `moved` rotates about the sensor's own origin, the motion is about the centre of the points.
    const Eigen::Vector3d arm = T_target_source.translation - middle;
    direction.motion.tail<3>() =
        motion.tail<3>() + Eigen::Vector3d(direction.motion.head<3>()).cross(arm);
    directions.push_back(direction);
  }
  return directions;
}

std::string dof_names_of(const std::vector<ConstraintDirection>& directions) {
  constexpr double kTakesPart = 0.4;  // Minimum share of a rotation, or of a translation.
  std::array<double, 6> shares{};
  for (const ConstraintDirection& direction : directions) {
    const double turn = direction.motion.head<3>().norm();
    const double shift = direction.motion.tail<3>().norm();
    for (int i = 0; i < 6; ++i) {
      // Rotations are compared with rotations and translations with translations. The whole counts
      // as at least 0.02 rad or 0.1 m per unit of the direction, so that the shares of a tiny
      // motion are small.
      const double whole = i < 3 ? std::max(turn, 0.02) : std::max(shift, 0.1);
      auto& share = shares[static_cast<std::size_t>(i)];
      share = std::max(share, std::abs(direction.motion(i)) / whole);
    }
  }
  std::vector<std::string> names;
  for (const std::size_t i : {3U, 4U, 5U, 0U, 1U, 2U}) {
    if (shares[i] > kTakesPart) names.push_back(kDofNames[i]);
  }
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    words += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return words;
}

}  // namespace croon
