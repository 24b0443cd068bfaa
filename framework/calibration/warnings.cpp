#include "framework/calibration/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "framework/base/statistics.hpp"
#include "framework/base/text.hpp"

namespace croon {
namespace {

/// Maximum difference between copies of a coordinate if one was rounded to millimetres.
constexpr float kRounding_m = 0.0011F;

/// Number of points below which a cloud is suspicious.
constexpr std::size_t kFewPoints = 1000;

/// Approximate number of points whose ranges are checked.
constexpr std::size_t kSampledPoints = 5000;

/// For each cloud, the index of the first cloud with the same points, possibly its own. Empty
/// clouds do not count as copies.
std::vector<std::size_t> first_copies(const std::vector<NamedCloud>& clouds) {
  std::map<std::size_t, std::vector<std::size_t>> firsts_by_size;
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    first.push_back(i);
    if (clouds[i].cloud->empty()) continue;
    std::vector<std::size_t>& firsts = firsts_by_size[clouds[i].cloud->size()];
    const auto copied = std::find_if(firsts.begin(), firsts.end(), [&](std::size_t other) {
      return have_same_points(*clouds[other].cloud, *clouds[i].cloud);
    });
    if (copied != firsts.end()) {
      first.back() = *copied;
    } else {
      firsts.push_back(i);
    }
  }
  return first;
}

std::string scene_text(const std::string& scene) {
  return scene.empty() ? std::string() : " in scene " + printable(scene);
}

/// The scenes with the indices of their clouds, in the order of their first clouds.
using CloudsByScene = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

CloudsByScene by_scene(const std::vector<NamedCloud>& clouds) {
  CloudsByScene scenes;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const auto known = std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) {
      return scene.first == clouds[i].scene;
    });
    if (known != scenes.end()) {
      known->second.push_back(i);
    } else {
      scenes.push_back({clouds[i].scene, {i}});
    }
  }
  return scenes;
}

/// The copied scenes, each with its original.
std::vector<std::pair<std::string, std::string>> scene_copies(
    const std::vector<NamedCloud>& clouds, const std::vector<std::size_t>& first) {
  std::vector<std::pair<std::string, std::string>> copies;
  for (const auto& [scene, members] : by_scene(clouds)) {
    const std::string& original = clouds[first[members.front()]].scene;
    if (original == scene) continue;
    const bool is_copy = std::all_of(members.begin(), members.end(), [&](std::size_t i) {
      const NamedCloud& of = clouds[first[i]];
      return of.scene == original && of.sensor == clouds[i].sensor;
    });
    if (is_copy) copies.emplace_back(scene, original);
  }
  return copies;
}

void warn_of_copies(const std::vector<NamedCloud>& clouds, std::vector<std::string>& warnings) {
  const std::vector<std::size_t> first = first_copies(clouds);
  std::set<std::string> copied;
  for (const auto& [scene, original] : scene_copies(clouds, first)) {
    copied.insert(scene);
    warnings.push_back("scene " + printable(scene) + " is a copy of scene " + printable(original) +
                       ": it does not count as evidence");
  }
  std::set<std::pair<std::string, std::string>> named;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const NamedCloud& one = clouds[first[i]];
    const NamedCloud& other = clouds[i];
    if (first[i] == i || copied.count(other.scene) > 0) continue;
    // Once per pair of sensors: a copied folder would repeat the warning for each scene.
    if (!named.insert({one.sensor, other.sensor}).second) continue;
    if (one.sensor == other.sensor) {
      warnings.push_back("the cloud of " + printable(other.sensor) + scene_text(other.scene) +
                         " is the same as in scene " + printable(one.scene) +
                         ", unlike the clouds of the other sensors: did its driver repeat a scan?");
    } else {
      warnings.push_back(printable(one.sensor) + scene_text(one.scene) + " and " +
                         printable(other.sensor) + scene_text(other.scene) +
                         " have the same points: is one file a copy of the other?");
    }
  }
}

/// Up to kSampledPoints of the points, evenly spaced by index.
Points sample_of(const Points& points) {
  const std::size_t step = points.size() / kSampledPoints + 1;
  Points sample;
  for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
  return sample;
}

double median_distance_m(const Points& points, const Eigen::Vector3f& from) {
  std::vector<double> distances_m;
  for (const Eigen::Vector3f& point : points) {
    distances_m.push_back(static_cast<double>((point - from).norm()));
  }
  return median(std::move(distances_m));
}

Eigen::Vector3f median_point(const Points& points) {
  Eigen::Vector3f middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3f& point : points) {
      values.push_back(static_cast<double>(point(axis)));
    }
    middle(axis) = static_cast<float>(median(std::move(values)));
  }
  return middle;
}

/// Why the unit or origin of the coordinates is suspicious, or empty. Median ranges of LiDARs are 1
/// m (in a room) to 50 m.
std::string why_odd_ranges(const Points& points) {
  constexpr double kCentimetres = 250.0, kMillimetres = 2500.0, kTooNear = 0.2;
  constexpr double kFarOrigin = 10.0;
  const Points sample = sample_of(points);
  const double range_m = median_distance_m(sample, Eigen::Vector3f::Zero());
  const std::string found = "the median range is " + plain_number(std::round(range_m)) + " m";
  const double spread_m = median_distance_m(sample, median_point(sample));
  if (range_m > 1.0 && range_m > kFarOrigin * spread_m && range_m > kCentimetres) {
    return found +
           ", and the points are close to each other: these look like map coordinates; expected "
           "coordinates in the frame of the sensor";
  }
  if (range_m >= kMillimetres) {
    return found + ": this looks like millimetres; expected coordinates in metres";
  }
  if (range_m >= kCentimetres) {
    return found + ": this looks like centimetres; expected coordinates in metres";
  }
  if (range_m > 0.0 && range_m < kTooNear) {
    return "the median range is only " + fixed_number(range_m, 3) +
           " m: are the coordinates in metres?";
  }
  return "";
}

/// Appends "SENSOR in scene SCENE: what" once per sensor and `kind` of warning.
class SensorWarnings {
 public:
  explicit SensorWarnings(std::vector<std::string>& warnings) : warnings_(warnings) {}

  void add(const NamedCloud& of, const std::string& kind, const std::string& what) {
    if (!named_.insert({of.sensor, kind}).second) return;
    warnings_.push_back(printable(of.sensor) + scene_text(of.scene) + ": " + what);
  }

 private:
  std::vector<std::string>& warnings_;
  std::set<std::pair<std::string, std::string>> named_;
};

void warn_of_points(const NamedCloud& of, SensorWarnings& warnings) {
  constexpr double kMaxUnmeasured = 0.5;
  const LoadedCloud& cloud = *of.cloud;
  Points points;
  std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(points),
               [](const Eigen::Vector3f& point) { return !point.isZero(0.0F); });
  const double count =
      static_cast<double>(cloud.size() + cloud.dropped_non_finite + cloud.dropped_zero);
  const double share = count > 0.0 ? 1.0 - static_cast<double>(points.size()) / count : 0.0;
  if (share > kMaxUnmeasured) {
    warnings.add(of, "zeros",
                 fixed_number(100.0 * share, 0) +
                     " % of the points are not finite or exactly zero: no measurements");
  }
  if (points.size() < kFewPoints) {
    warnings.add(of, "few", "only " + counted(points.size(), "point") + " usable");
  }
  if (points.empty()) return;
  const std::string odd = why_odd_ranges(points);
  if (!odd.empty()) warnings.add(of, "ranges", odd);
}

/// The first and last time of a scan, in seconds.
struct TimeRange {
  double first_s, last_s;
};

/// std::nullopt without times of one scan; check_times reports the reason.
std::optional<TimeRange> time_range(const PointCloud& cloud) {
  constexpr double kMaxDuration_s = 1.0;
  if (cloud.empty() || find_channel(cloud, kTime) == nullptr) return std::nullopt;
  const std::vector<double> times = times_s(cloud);
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  if (!std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); }) ||
      *last - *first > kMaxDuration_s) {
    return std::nullopt;
  }
  return TimeRange{*first, *last};
}

/// "0.4 s", "12 min".
std::string duration_text(double duration_s) {
  constexpr double kMinute_s = 60.0, kHour_s = 3600.0;
  if (duration_s < 2.0 * kMinute_s)
    return fixed_number(duration_s, duration_s < 10.0 ? 2 : 0) + " s";
  if (duration_s < 2.0 * kHour_s) return fixed_number(duration_s / kMinute_s, 0) + " min";
  return fixed_number(duration_s / kHour_s, 0) + " h";
}

/// Warns about scans with a long gap before or after the first sensor's scan.
void warn_of_times(const std::vector<NamedCloud>& clouds, SensorWarnings& warnings) {
  constexpr double kMaxGap_s = 0.15, kOtherClock_s = 86400.0;
  for (const auto& [scene, members] : by_scene(clouds)) {
    const NamedCloud& reference = clouds[members.front()];
    const std::optional<TimeRange> expected = time_range(*reference.cloud);
    for (const std::size_t i : members) {
      const std::optional<TimeRange> found = time_range(*clouds[i].cloud);
      if (!expected || !found) continue;
      const double gap_s =
          std::max(found->first_s - expected->last_s, expected->first_s - found->last_s);
      if (gap_s <= kMaxGap_s) continue;
      const std::string apart = "its time stamps are " + duration_text(gap_s) +
                                " away from those of " + printable(reference.sensor);
      warnings.add(
          clouds[i], "times",
          gap_s > kOtherClock_s
              ? apart + ": the two clocks are not synchronised"
              : apart + ": if the vehicle moved in between, the pose is wrong by that motion");
    }
  }
}

}  // namespace

bool have_same_points(const PointCloud& a, const PointCloud& b) {
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
                      return (p - q).cwiseAbs().maxCoeff() <= kRounding_m;
                    });
}

std::vector<std::string> warnings_about_clouds(const std::vector<NamedCloud>& clouds) {
  std::vector<std::string> warnings;
  warn_of_copies(clouds, warnings);
  SensorWarnings by_sensor(warnings);
  for (const NamedCloud& of : clouds) warn_of_points(of, by_sensor);
  warn_of_times(clouds, by_sensor);
  return warnings;
}

std::vector<std::string> copied_scenes(const std::vector<NamedCloud>& clouds) {
  std::vector<std::string> scenes;
  for (const auto& [scene, original] : scene_copies(clouds, first_copies(clouds))) {
    scenes.push_back(scene);
  }
  return scenes;
}

}  // namespace croon
