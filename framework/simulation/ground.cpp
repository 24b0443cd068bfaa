#include "framework/simulation/ground.hpp"

#include <cmath>
#include <cstdint>

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A uniform random value with a standard deviation of 1 that depends only on the corner (i, j).
double corner_value(const StreamKey& key, std::int64_t i, std::int64_t j) {
  const std::uint64_t bits =
      key.with(static_cast<std::uint64_t>(i)).with(static_cast<std::uint64_t>(j)).value();
  const double uniform = static_cast<double>(bits >> 11) * 0x1.0p-53;
  return std::sqrt(12.0) * (uniform - 0.5);
}

/// Smoothstep from 0 to 1 (3 t^2 - 2 t^3).
double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

/// Smooth noise over the plane with a standard deviation of about 1 and features of about
/// `wavelength_m`: value noise, a smooth blend of independent values at the corners of a square
/// lattice.
double surface_noise(const StreamKey& key, double s_m, double d_m, double wavelength_m) {
  const double u = s_m / wavelength_m;
  const double v = d_m / wavelength_m;
  const double i = std::floor(u);
  const double j = std::floor(v);
  const auto corner = [&](int di, int dj) {
    return corner_value(key, static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj);
  };
  const double a = smooth(u - i);
  const double b = smooth(v - j);
  const double near = (1.0 - a) * corner(0, 0) + a * corner(1, 0);
  const double far = (1.0 - a) * corner(0, 1) + a * corner(1, 1);
  // Blending halves the variance twice in the middle of a cell; 1.4 compensates for it on average.
  return 1.4 * ((1.0 - b) * near + b * far);
}

}  // namespace

double Ground::roughness_m(double s_m, double d_m) const {
  constexpr double kLong_m = 6.0;
  constexpr double kShort_m = 1.5;
  return shape_.roughness_at(s_m, d_m) *
         (0.8 * surface_noise(key_.with("long"), s_m, d_m, kLong_m) +
          0.6 * surface_noise(key_.with("short"), s_m, d_m, kShort_m));
}

Vector3d Ground::point(double s_m, double d_m, double above_m) const {
  const double turn_rad = heading_rad(s_m);
  const double half_rad = 0.5 * turn_rad;
  // The centre line is an arc of length s. Its chord has the length s sin(half) / half and half of
  // the arc's turn.
  const double chord_m = std::abs(half_rad) < 1e-9 ? s_m : s_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad) - d_m * std::sin(turn_rad),
          chord_m * std::sin(half_rad) + d_m * std::cos(turn_rad),
          shape_.height_m(s_m, d_m) + roughness_m(s_m, d_m) + above_m};
}

RigidTransform Ground::upright(double s_m, double d_m, double yaw_rad) const {
  return {rotation_from_rpy({0.0, 0.0, heading_rad(s_m) + yaw_rad}), point(s_m, d_m)};
}

RigidTransform Ground::on_slope(double s_m, double d_m, double yaw_rad) const {
  // Half the wheelbase and half the track of a car.
  constexpr double kHalfBase_m = 1.3;
  constexpr double kHalfTrack_m = 0.75;
  const double cosine = std::cos(yaw_rad);
  const double sine = std::sin(yaw_rad);
  const Vector3d front = point(s_m + kHalfBase_m * cosine, d_m + kHalfBase_m * sine);
  const Vector3d rear = point(s_m - kHalfBase_m * cosine, d_m - kHalfBase_m * sine);
  const Vector3d left = point(s_m - kHalfTrack_m * sine, d_m + kHalfTrack_m * cosine);
  const Vector3d right = point(s_m + kHalfTrack_m * sine, d_m - kHalfTrack_m * cosine);
  RigidTransform pose;
  pose.rotation.col(0) = (front - rear).normalized();
  pose.rotation.col(2) = pose.rotation.col(0).cross(left - right).normalized();
  pose.rotation.col(1) = pose.rotation.col(2).cross(pose.rotation.col(0));
  pose.translation = 0.25 * (front + rear + left + right);
  return pose;
}

void Ground::add_to(Mesh& mesh) const {
  const std::vector<double> along = shape_.grid_s_m();
  const std::vector<double> across = shape_.grid_d_m();
  const auto first = mesh.next_vertex();
  for (const double s_m : along) {
    for (const double d_m : across) mesh.add_vertex(point(s_m, d_m));
  }
  const auto row = static_cast<std::uint32_t>(across.size());
  for (std::uint32_t i = 0; i + 1 < along.size(); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t corner = first + i * row + j;
      mesh.add_quad(
          corner, corner + row, corner + row + 1, corner + 1,
          shape_.material_at(0.5 * (along[i] + along[i + 1]), 0.5 * (across[j] + across[j + 1])));
    }
  }
}

}  // namespace croon::simulation
