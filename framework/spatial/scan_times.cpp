#include "framework/spatial/scan_times.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/base/text.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

// A mounting may leave a short part of a revolution visible; a LiDAR packet lasts 1 to 2 ms.
constexpr double kShortestScan_s = 5e-3;
constexpr double kLongestScan_s = 1.0;

/// A sample of points for checking times, in the order of the cloud.
struct TimedDirections {
  std::vector<double> times_s;
  std::vector<Eigen::Vector3d> directions;  ///< Unit vectors from the sensor.
};

TimedDirections directions_of(const PointCloud& cloud, const std::vector<double>& times) {
  constexpr std::size_t kMaxPoints = 20000;
  TimedDirections sample;
  const std::size_t count = std::min(cloud.size(), kMaxPoints);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = evenly_spaced_index(n, cloud.size(), count);
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    const double range_m = point.norm();
    if (range_m == 0.0) continue;
    sample.times_s.push_back(times[i]);
    sample.directions.emplace_back(point / range_m);
  }
  return sample;
}

/// The share, 0 to 1, of the variance of the directions that is explained by the times: points
/// measured at similar times lie in similar directions. About 1/20 or less if times and directions
/// are unrelated.
double explained_share(const TimedDirections& sample) {
  constexpr std::size_t kMaxBins = 200, kMinPointsPerBin = 20;
  const std::size_t size = sample.times_s.size();
  const std::size_t bins = std::min(kMaxBins, size / kMinPointsPerBin);
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sample.times_s[a] < sample.times_s[b];
  });
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double within = static_cast<double>(size);
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t first = b * size / bins, last = (b + 1) * size / bins;
    Eigen::Vector3d of_bin = Eigen::Vector3d::Zero();
    for (std::size_t k = first; k < last; ++k) of_bin += sample.directions[order[k]];
    within -= of_bin.squaredNorm() / static_cast<double>(last - first);
    sum += of_bin;
  }
  const auto count = static_cast<double>(size);
  const double total = count - sum.squaredNorm() / count;
  return total > 0.0 ? 1.0 - within / total : 0.0;
}

/// Whether the times decrease in the order of the points, or within each ring if the points are
/// stored ring by ring. False if the points are not in temporal order.
bool decrease_along_the_cloud(const std::vector<double>& times_s) {
  constexpr double kMaxRestarts = 0.05;
  const TimeSpan span = span_of(times_s);
  const double length_s = span.last_s - span.first_s;
  double drift_s = 0.0, restarts = 0.0;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    const double step_s = times_s[i] - times_s[i - 1];
    if (std::abs(step_s) > 0.5 * length_s) {
      restarts += 1.0;
    } else {
      drift_s += step_s;
    }
  }
  return restarts <= kMaxRestarts * static_cast<double>(times_s.size()) &&
         drift_s < -0.5 * length_s;
}

std::string why_unusable(const PointCloud& cloud) {
  const std::vector<double> times = times_s(cloud);
  if (times.empty()) return "the cloud has no points";
  const auto bad =
      std::count_if(times.begin(), times.end(), [](double t) { return !std::isfinite(t); });
  if (bad > 0) {
    return std::to_string(bad) + " of " + std::to_string(times.size()) + " times are not finite";
  }
  const TimeSpan span = span_of(times);
  const double length_s = span.last_s - span.first_s;
  if (length_s == 0.0) return "all times are equal";
  if (length_s < kShortestScan_s || length_s > kLongestScan_s) {
    return "the times span " + plain_number(length_s) + " s, but a scan lasts " +
           plain_number(kShortestScan_s) + " to " + plain_number(kLongestScan_s) +
           " s: expected seconds, or whole nanoseconds, that do not restart within a scan";
  }
  constexpr std::size_t kMinPoints = 200;
  constexpr double kMinExplained = 0.25;
  const TimedDirections sample = directions_of(cloud, times);
  if (sample.times_s.size() < kMinPoints) return "the cloud has too few points to check its times";
  if (explained_share(sample) < kMinExplained) {
    return "the times are unrelated to the directions of the points";
  }
  if (decrease_along_the_cloud(sample.times_s)) {
    return "the times decrease in the order of the points, as if they were reversed";
  }
  return "";
}

std::string milliseconds(double time_s) { return fixed_number(1e3 * time_s, 0) + " ms"; }

}  // namespace

TimeCheck check_times(const PointCloud& cloud) {
  if (find_channel(cloud, kTime) == nullptr) return {false, false, "the cloud has no times"};
  const std::string reason = why_unusable(cloud);
  return {true, reason.empty(), reason};
}

std::string why_not_one_clock(const std::vector<std::string>& names,
                              const std::vector<const PointCloud*>& clouds) {
  // One scene cannot distinguish a clock offset from a shift along the road. Scans of free-running
  // sensors, paired by time, are up to half a revolution apart; those of synchronised sensors less.
  constexpr double kMaxApart = 0.45;
  if (clouds.empty()) return "";
  const TimeSpan reference = span_of(times_s(*clouds.front()));
  for (std::size_t i = 1; i < clouds.size(); ++i) {
    const TimeSpan span = span_of(times_s(*clouds[i]));
    const double later_s = span.middle_s() - reference.middle_s();
    const double scan_s =
        std::max(span.last_s - span.first_s, reference.last_s - reference.first_s);
    if (std::abs(later_s) <= kMaxApart * scan_s) continue;
    const std::string sensors = names.at(i) + " and " + names.front();
    if (std::abs(later_s) > kLongestScan_s) {
      return "the clocks of " + sensors + " have different epochs: their scans are " +
             plain_number(std::round(std::abs(later_s) * 10.0) / 10.0) + " s apart";
    }
    return "the scan of " + names.at(i) + " is " + milliseconds(std::abs(later_s)) +
           (later_s > 0.0 ? " later" : " earlier") + " than the scan of " + names.front() +
           ", too much for scans of " + milliseconds(scan_s) +
           ": their clocks differ, or the clouds are from different moments";
  }
  return "";
}

}  // namespace croon
