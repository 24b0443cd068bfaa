#include "framework/calibration/reference_hint.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/reasons_in_words.hpp"

namespace croon {
namespace {

/// The solid angle in which a sensor measured, in cells of equal area: independent of the mounting,
/// up to the width of a cell.
std::size_t seen_cells(const Cloud& cloud) {
  constexpr double kCellsPerTurn = 36.0, kCellsPerRadius = 9.0;
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector3f& point : cloud.points()) {
    const double range_m = point.norm();
    if (range_m <= 0.0) continue;
    const double turns = std::atan2(point.y(), point.x()) / (2.0 * kPi);
    cells.emplace(static_cast<int>(std::floor(kCellsPerTurn * turns)),
                  static_cast<int>(std::floor(kCellsPerRadius * point.z() / range_m)));
  }
  return cells.size();
}

bool lacks_common_view(const CalibratedSensor& sensor) {
  return !sensor.is_accepted && std::find(sensor.advice.begin(), sensor.advice.end(),
                                          kMoreSharedView) != sensor.advice.end();
}

bool is_accepted_sensor(const CalibratedRig& rig, const std::string& name) {
  return std::any_of(rig.sensors.begin(), rig.sensors.end(), [&](const CalibratedSensor& sensor) {
    return sensor.sensor == name && sensor.is_accepted;
  });
}

}  // namespace

std::string reference_hint(const CalibratedRig& rig) {
  constexpr double kMuchLarger = 1.5;
  const auto rejected = std::find_if(rig.sensors.begin(), rig.sensors.end(), lacks_common_view);
  // The common view of two sensors is the same whichever is the reference.
  if (rejected == rig.sensors.end() || rig.sensors.size() < 2 || !rig.shown.reference) return "";
  std::string widest;
  auto cells =
      static_cast<std::size_t>(kMuchLarger * static_cast<double>(seen_cells(*rig.shown.reference)));
  for (const ShownSensor& sensor : rig.shown.sensors) {
    const std::size_t seen = seen_cells(*sensor.cloud);
    if (seen <= cells) continue;
    widest = sensor.sensor;
    cells = seen;
  }
  const bool is_at_rest = std::all_of(
      rig.motion.begin(), rig.motion.end(),
      [](const SceneMotionEstimate& scene) { return vector_of(scene.velocity).isZero(0.0); });
  // At rest, `sensor_graph` has compared rejected sensors with the accepted ones.
  if (widest.empty() || (is_at_rest && is_accepted_sensor(rig, widest))) return "";
  return printable(rejected->sensor) + " shares too little view with the reference " +
         printable(rig.reference) + ", the first sensor; " + printable(widest) +
         " has a larger field of view: try --reference " + printable(widest);
}

}  // namespace croon
