#include "framework/registration/beam_errors.hpp"

#include <cmath>

#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/icp_options.hpp"

namespace croon {
namespace {

constexpr int kTermsOfSensor = 8;
using OfSensor = Eigen::Matrix<double, 1, kTermsOfSensor>;
using OfPair = Eigen::Matrix<double, 1, 2 * kTermsOfSensor>;
using PoseByTerm = Eigen::Matrix<double, 6, 2 * kTermsOfSensor>;

/// The shifts of `point` along `normal`, both in the frame of a sensor, for terms of one standard
/// deviation.
OfSensor shifts(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                const BeamErrors& errors) {
  const double across = point.head<2>().norm();
  if (!(across > 0.0)) return OfSensor::Zero();
  const double azimuth = std::atan2(point.y(), point.x());
  const double elevation = std::atan2(point.z(), across);
  const double range = point.norm();
  const Eigen::Vector3d east(-point.y(), point.x(), 0.0);
  const Eigen::Vector3d up = point.cross(east) / across;
  const double by_azimuth = normal.dot(east) * errors.azimuth_rad;
  const double by_elevation = normal.dot(up) * errors.elevation_rad;
  OfSensor terms;
  terms << by_azimuth * std::sin(azimuth), by_azimuth * std::cos(azimuth),
      by_azimuth * std::sin(2.0 * azimuth), by_azimuth * std::cos(2.0 * azimuth),
      by_azimuth * elevation, by_elevation, by_elevation * elevation,
      normal.dot(point) / range * errors.range_m;
  return terms;
}

}  // namespace

std::optional<Matrix6d> covariance_of_beam_errors(const std::vector<ComparedScan>& scans,
                                                  const BeamErrors& errors) {
  constexpr std::size_t kMinTouches = 60;
  constexpr double kKernel_m = 0.1;
  const RobustKernel kernel(Kernel::geman_mcclure, kKernel_m);
  Matrix6d information = Matrix6d::Zero();
  PoseByTerm coupling = PoseByTerm::Zero();
  std::size_t count = 0;
  for (const ComparedScan& scan : scans) {
    const Eigen::Matrix3d to_source = scan.T_target_source.rotation.transpose();
    const SurfaceTouches touches = surface_touches(scan, touches_per_scan(scans.size()));
    count += touches.points.size();
    for (const SurfaceTouch& touch : touches.points) {
      const double weight = touch.balance * kernel.weight(touch.distance_m * touch.distance_m);
      OfPair terms;
      terms << shifts(touch.of_source, to_source * touch.normal, errors),
          -shifts(touch.of_target, touch.normal, errors);
      information += weight * (touch.by_pose * touch.by_pose.transpose());
      coupling += weight * (touch.by_pose * terms);
    }
  }
  if (count < kMinTouches) return std::nullopt;
  const PoseByTerm steps = guarded_inverse<6>(information) * coupling;
  return symmetric<6>(steps * steps.transpose());
}

}  // namespace croon
