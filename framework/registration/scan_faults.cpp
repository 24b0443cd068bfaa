#include "framework/registration/scan_faults.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/icp_options.hpp"

namespace croon {
namespace {

constexpr std::size_t kMinScanContacts = 60;  ///< Of a scan.
/// Widths of the robust kernel by iteration: wide at first, because a fault moves points far.
constexpr double kContactKernels_m[] = {0.4, 0.2, 0.1, 0.1, 0.1};

/// Estimates of K sizes of a fault.
template <int K>
struct Sizes {
  using Vector = Eigen::Matrix<double, K, 1>;
  using Matrix = Eigen::Matrix<double, K, K>;
  Vector value = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  double cost = 0.0;  ///< Robust, of all touches at the estimate.
};

/// The normal equations of the sizes in one scan, with its pose eliminated.
template <int K>
struct ReducedScan {
  Eigen::Matrix<double, K, K> information, scatter;
  Eigen::Matrix<double, K, 1> gradient;
  Vector6d pose_step;
  Eigen::Matrix<double, 6, K> pose_by_size;
  double cost = 0.0;  ///< Robust.
};

/// `by_size(touch)` is the change of the distance of a touch with the sizes.
template <int K, class BySize>
ReducedScan<K> reduced_scan(const SurfaceTouches& touches, const Vector6d& pose,
                            const Eigen::Matrix<double, K, 1>& sizes, double kernel_m,
                            const BySize& by_size) {
  using Row = Eigen::Matrix<double, 6 + K, 1>;
  const RobustKernel kernel(Kernel::geman_mcclure, kernel_m);
  Eigen::Matrix<double, 6 + K, 6 + K> information = Eigen::Matrix<double, 6 + K, 6 + K>::Zero();
  std::vector<Row> surfaces(touches.surfaces, Row::Zero());
  ReducedScan<K> scan;
  for (const SurfaceTouch& touch : touches.points) {
    Row J;
    J << touch.by_pose, by_size(touch);
    const double residual_m =
        touch.distance_m + J.template head<6>().dot(pose) + J.template tail<K>().dot(sizes);
    const double share = kernel.weight(residual_m * residual_m);
    const double weight = touch.balance * share;
    scan.cost += touch.balance * residual_m * residual_m * std::sqrt(share);
    information.noalias() += weight * (J * J.transpose());
    surfaces[touch.surface] += weight * residual_m * J;
  }
  const Matrix6d inverse = guarded_inverse<6>(information.template topLeftCorner<6, 6>());
  const Eigen::Matrix<double, 6, K> coupling = information.template topRightCorner<6, K>();
  scan.pose_by_size = -inverse * coupling;
  scan.information =
      information.template bottomRightCorner<K, K>() + coupling.transpose() * scan.pose_by_size;
  scan.gradient.setZero();
  scan.scatter.setZero();
  Vector6d of_pose = Vector6d::Zero();
  for (const Row& gradient : surfaces) {
    const Eigen::Matrix<double, K, 1> own =
        gradient.template tail<K>() + scan.pose_by_size.transpose() * gradient.template head<6>();
    scan.gradient += own;
    scan.scatter += own * own.transpose();
    of_pose += gradient.template head<6>();
  }
  scan.pose_step = -inverse * of_pose;
  return scan;
}

/// Estimates sizes together with the pose in each scan.
template <int K, class BySize>
Sizes<K> estimate_sizes(const std::vector<SurfaceTouches>& scans, double surfaces,
                        const BySize& by_size) {
  using Matrix = Eigen::Matrix<double, K, K>;
  Sizes<K> sizes;
  std::vector<Vector6d> poses(scans.size(), Vector6d::Zero());
  for (const double kernel_m : kContactKernels_m) {
    Matrix information = Matrix::Zero(), scatter = Matrix::Zero();
    Eigen::Matrix<double, K, 1> gradient = Eigen::Matrix<double, K, 1>::Zero();
    std::vector<ReducedScan<K>> reduced;
    sizes.cost = 0.0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
      reduced.push_back(reduced_scan<K>(scans[s], poses[s], sizes.value, kernel_m, by_size));
      information += reduced.back().information;
      scatter += reduced.back().scatter;
      gradient += reduced.back().gradient;
      sizes.cost += reduced.back().cost;
    }
    const Matrix inverse = guarded_inverse<K>(information);
    const double unknowns = static_cast<double>(K + 6 * scans.size());
    const double widening = surfaces / std::max(surfaces - unknowns, 0.1);
    sizes.covariance = widening * inverse * scatter * inverse;
    const Eigen::Matrix<double, K, 1> change = -inverse * gradient;
    sizes.value += change;
    for (std::size_t s = 0; s < scans.size(); ++s) {
      poses[s] += reduced[s].pose_step + reduced[s].pose_by_size * change;
    }
  }
  return sizes;
}

/// The effective number (equally weighted) of surfaces.
double effective_surfaces(const std::vector<SurfaceTouches>& scans) {
  double sum = 0.0, squares = 0.0;
  for (const SurfaceTouches& touches : scans) {
    std::vector<double> weights(touches.surfaces, 0.0);
    for (const SurfaceTouch& touch : touches.points) weights[touch.surface] += touch.balance;
    for (const double weight : weights) {
      sum += weight;
      squares += weight * weight;
    }
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

}  // namespace

ScanFaults estimate_scan_faults(const std::vector<ComparedScan>& scans) {
  std::vector<SurfaceTouches> compared;
  std::vector<double> ranges_m;
  const std::size_t max_points = touches_per_scan(scans.size());
  for (const ComparedScan& scan : scans) {
    SurfaceTouches touches = surface_touches(scan, max_points);
    if (touches.points.size() < kMinScanContacts) continue;
    for (const SurfaceTouch& touch : touches.points) ranges_m.push_back(touch.of_source.norm());
    compared.push_back(std::move(touches));
  }
  ScanFaults faults;
  faults.surfaces = effective_surfaces(compared);
  if (compared.empty()) return faults;
  const Sizes<2> range =
      estimate_sizes<2>(compared, faults.surfaces, [](const SurfaceTouch& touch) {
        return Eigen::Vector2d(touch.by_range * touch.of_source.norm(), touch.by_range);
      });
  // The correction of the ranges is the negative of their error.
  faults.range = {-range.value(0), -range.value(1), range.covariance, median(ranges_m)};
  const double cost_of_pose = estimate_sizes<1>(compared, faults.surfaces, [](const SurfaceTouch&) {
                                return Eigen::Matrix<double, 1, 1>::Zero().eval();
                              }).cost;
  constexpr int kSplits = 4;
  for (int split = 0; split < kSplits; ++split) {
    const double azimuth_rad = split * kPi / kSplits;
    const Sizes<3> half = estimate_sizes<3>(
        compared, faults.surfaces, [&](const SurfaceTouch& touch) -> Eigen::Vector3d {
          const bool is_inside =
              std::sin(std::atan2(touch.of_source.y(), touch.of_source.x()) - azimuth_rad) >= 0.0;
          return is_inside ? touch.normal : Eigen::Vector3d::Zero();
        });
    faults.halves.push_back({azimuth_rad, -half.value, half.covariance,
                             cost_of_pose > 0.0 ? half.cost / cost_of_pose : 1.0});
  }
  return faults;
}

}  // namespace croon
