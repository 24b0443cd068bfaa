#include "experiments/run/pose_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

constexpr double kUnitTolerance = 1e-6;

int trial_number(const std::string& text) {
  const std::optional<std::uint64_t> number = count_from(text);
  if (!number || *number >= kMaxTrials) {
    refuse("a trial, a whole number from 0 to " + std::to_string(kMaxTrials - 1), in_quotes(text));
  }
  return static_cast<int>(*number);
}

/// Normalises the quaternion; one that has unit length except for rounding keeps its bits, so that
/// a start is read exactly as written.
Eigen::Quaterniond unit(const Eigen::Quaterniond& q) {
  const double length = q.norm();
  if (std::abs(length - 1.0) > kUnitTolerance) {
    refuse("a quaternion of length 1", "one of length " + std::to_string(length));
  }
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::abs(length - 1.0) <= kRounding ? q : q.normalized();
}

/// Parses a line. Throws InputError("expected ..., found ...").
PoseLine read_line(const CsvLine& csv) {
  const bool has_trial = csv.header == kStartHeader;
  const std::vector<std::string>& fields = csv.fields;
  const std::size_t names = has_trial ? 3 : 2;
  require_fields(csv, names + 7);
  PoseLine line{fields[0], fields[1], has_trial ? trial_number(fields[2]) : -1, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    line.pose.translation(static_cast<int>(i)) =
        bounded_number(fields[names + i], kMaxCoordinate_m, "m");
  }
  Eigen::Quaterniond q;
  for (std::size_t i = 0; i < 4; ++i) {
    q.coeffs()(static_cast<int>(i)) = finite_number(fields[names + 3 + i]);
  }
  line.pose.rotation = unit(q);
  return line;
}

}  // namespace

DatasetNames::DatasetNames(const std::vector<SceneGroup>& groups) {
  for (const SceneGroup& group : groups) {
    scenes_.push_back(group.name);
    for (const SensorPair& pair : group.pairs) sensors_[group.name].push_back(pair.name);
  }
}

bool DatasetNames::has(const std::string& scene, const std::string& sensor) const {
  const auto found = sensors_.find(scene);
  return found != sensors_.end() &&
         std::find(found->second.begin(), found->second.end(), sensor) != found->second.end();
}

void DatasetNames::check(const std::string& scene, const std::string& sensor) const {
  const auto found = sensors_.find(scene);
  if (found == sensors_.end()) {
    refuse("a scene of the dataset", in_quotes(scene) + name_hint(scene, scenes_));
  }
  const std::vector<std::string>& sensors = found->second;
  if (std::find(sensors.begin(), sensors.end(), sensor) != sensors.end()) return;
  refuse("a sensor of scene " + in_quotes(scene), in_quotes(sensor) + name_hint(sensor, sensors));
}

std::string read_pose_file(const std::filesystem::path& path,
                           const std::vector<std::string>& headers, const DatasetNames& names,
                           const std::function<void(const PoseLine&)>& add) {
  return read_given_csv(path, headers, [&](const CsvLine& csv) {
    const PoseLine line = read_line(csv);
    if (!csv.is_shown && !names.has(line.scene, line.sensor)) refuse("", "");
    names.check(line.scene, line.sensor);
    add(line);
  });
}

}  // namespace croon::experiments
