#include "framework/registration/sweep_times.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon {
namespace {

double azimuth_rad(const Eigen::Vector3f& point) {
  return std::atan2(static_cast<double>(point.y()), static_cast<double>(point.x()));
}

/// The mean azimuth of the first hundredth of the points.
double first_azimuth_rad(const Points& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < std::max<std::size_t>(1, points.size() / 100); ++i) {
    const double azimuth = azimuth_rad(points[i]);
    sum += Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
  }
  return std::atan2(sum.y(), sum.x());
}

}  // namespace

Sweep sweep_of(const Points& points) {
  // Rings that fire at different azimuths and gaps between returns cause smaller steps.
  constexpr double kLargeStep_rad = kPi / 3.0;
  constexpr double kMaxLargeSteps = 0.1;
  constexpr double kMinTurn_rad = kPi / 4.0, kMaxTurn_rad = 2.5 * kPi;
  const Sweep unknown = {-kPi, false};
  double turned_rad = 0.0, large_steps = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step_rad =
        std::remainder(azimuth_rad(points[i]) - azimuth_rad(points[i - 1]), 2.0 * kPi);
    if (std::abs(step_rad) > kLargeStep_rad) {
      large_steps += 1.0;
    } else {
      turned_rad += step_rad;
    }
  }
  const bool is_ordered = large_steps <= kMaxLargeSteps * static_cast<double>(points.size()) &&
                          std::abs(turned_rad) >= kMinTurn_rad;
  if (!is_ordered) return unknown;
  const bool is_one_turn = std::abs(turned_rad) <= kMaxTurn_rad;
  return {is_one_turn ? first_azimuth_rad(points) : -kPi, turned_rad < 0.0};
}

std::vector<double> sweep_times_s(const Points& points, const Sweep& sweep, double period_s) {
  std::vector<double> times;
  times.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    const double turned_rad = azimuth_rad(point) - sweep.begin_rad;
    const double turns = (sweep.is_clockwise ? -turned_rad : turned_rad) / (2.0 * kPi);
    times.push_back(period_s * (turns - std::floor(turns)));
  }
  return times;
}

}  // namespace croon
