#include "framework/io/common_offset.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/text.hpp"
#include "framework/geometry/time_unit.hpp"

namespace croon {
namespace {

/// Coordinates beyond this are map coordinates.
constexpr double kMaxRange_m = 10e3;
/// Coordinates beyond this are damaged: the Earth has a radius of 6400 km.
constexpr double kMaxMap_m = 1e8;

/// Whether all coordinates were floats before the offset was subtracted.
bool were_floats(const LoadedCloud& cloud, Eigen::Index axis) {
  return std::all_of(cloud.points.begin(), cloud.points.end(), [&](const Eigen::Vector3f& point) {
    const double before = static_cast<double>(point(axis)) + cloud.origin_m(axis);
    return before == static_cast<double>(static_cast<float>(before));
  });
}

}  // namespace

Eigen::Vector3d common_offset_m(const Points& points) {
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto is_far = [axis](const Eigen::Vector3f& point) {
      return std::abs(static_cast<double>(point(axis))) > kMaxRange_m;
    };
    const auto far = std::count_if(points.begin(), points.end(), is_far);
    if (2 * static_cast<std::size_t>(far) <= points.size()) continue;
    std::vector<float> coordinates;
    coordinates.reserve(points.size());
    for (const Eigen::Vector3f& point : points) coordinates.push_back(point(axis));
    const auto middle = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
    std::nth_element(coordinates.begin(), middle, coordinates.end());
    const auto median_m = static_cast<double>(*middle);
    constexpr double kKilometre_m = 1000.0;
    // If half of the points lie far in front and half far behind, there is no common offset.
    if (std::abs(median_m) > kMaxRange_m && std::abs(median_m) < kMaxMap_m) {
      offset_m(axis) = kKilometre_m * std::round(median_m / kKilometre_m);
    }
  }
  return offset_m;
}

void note_common_offset(LoadedCloud& cloud) {
  std::string note = "The coordinates are map coordinates: (" + plain_number(cloud.origin_m.x()) +
                     ", " + plain_number(cloud.origin_m.y()) + ", " +
                     plain_number(cloud.origin_m.z()) + ") m is subtracted";
  double step_m = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (cloud.origin_m(axis) == 0.0 || !were_floats(cloud, axis)) continue;
    const auto origin = static_cast<float>(std::abs(cloud.origin_m(axis)));
    step_m = std::max(step_m, static_cast<double>(std::nextafter(origin, 2.0F * origin) - origin));
  }
  if (step_m > 0.0) {
    note += "; the file has single precision, with steps of " + plain_number(step_m) + " m";
  }
  cloud.notes.push_back(note + ".");
}

void check_unit_of_times(LoadedCloud& cloud) {
  const auto is_time = [](const Channel& channel) { return channel.name == kTime; };
  const auto time = std::find_if(cloud.channels.begin(), cloud.channels.end(), is_time);
  if (time == cloud.channels.end() || cloud.empty() || time->count != 1) return;
  const std::vector<double> times = channel_values(cloud, kTime);
  const ScalarKind kind = time->type.kind;
  if (restart_in_packets(times, kind)) {
    time->name = kTimeInPacket;
    cloud.notes.push_back(
        "The times restart in every packet of the sensor, so they are not used; record them "
        "relative to the scan.");
    return;
  }
  const TimeUnit unit = unit_of_times(times, kind);
  if (unit == convention_of(kind)) return;
  // The unit could not be inferred from a subset of the points.
  set_channel(cloud, make_channel(kTime, times_s(cloud)));
  cloud.notes.push_back(std::string("The times are assumed to be in ") + name_of(unit) + ".");
}

}  // namespace croon
