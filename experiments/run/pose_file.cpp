#include "experiments/run/pose_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

constexpr double kUnitTolerance = 1e-6;

/// Throws the InputError of a line: expected ..., found ...
[[noreturn]] void refuse(const std::string& expected, const std::string& found) {
  throw InputError("", "", "expected " + expected + ", found " + found);
}

/// The fields of a line of RFC 4180, without the quotes.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields = {""};
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_doubled = is_quoted && line.compare(i, 2, "\"\"") == 0;
    if (line[i] == '"' && !is_doubled) {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
      if (is_doubled) ++i;
    }
  }
  if (is_quoted) refuse("a second quote", in_quotes(line));
  return fields;
}

double finite_number(const std::string& text) {
  const std::optional<double> number = number_from(text);
  if (!number) refuse("a number", in_quotes(text));
  if (!std::isfinite(*number)) refuse("a finite number", in_quotes(text));
  return *number;
}

double coordinate(const std::string& text) {
  const double number_m = finite_number(text);
  if (std::abs(number_m) > kLargestCoordinate_m) {
    refuse("a number of at most " + fixed_number(kLargestCoordinate_m, 0) + " m", in_quotes(text));
  }
  return number_m;
}

int trial_number(const std::string& text) {
  const std::optional<std::uint64_t> number = count_from(text);
  if (!number || *number >= kMaxTrials) {
    refuse("a trial, a whole number from 0 to " + std::to_string(kMaxTrials - 1), in_quotes(text));
  }
  return static_cast<int>(*number);
}

/// The quaternion with unit length. If only rounding keeps it from unit length it keeps its bits,
/// so that a start is read as it was written.
Eigen::Quaterniond unit(const Eigen::Quaterniond& q) {
  const double length = q.norm();
  if (std::abs(length - 1.0) > kUnitTolerance) {
    refuse("a quaternion of length 1", "one of length " + std::to_string(length));
  }
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::abs(length - 1.0) <= kRounding ? q : q.normalized();
}

/// The parts of the line `text`. Throws InputError: expected ..., found ...
PoseLine read_line(const std::string& text, bool has_trial) {
  const std::vector<std::string> fields = fields_of(text);
  const std::size_t names = has_trial ? 3 : 2;
  if (fields.size() != names + 7) {
    refuse(std::to_string(names + 7) + " fields", std::to_string(fields.size()));
  }
  PoseLine line{fields[0], fields[1], has_trial ? trial_number(fields[2]) : -1, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    line.pose.translation(static_cast<int>(i)) = coordinate(fields[names + i]);
  }
  Eigen::Quaterniond q;
  for (std::size_t i = 0; i < 4; ++i) {
    q.coeffs()(static_cast<int>(i)) = finite_number(fields[names + 3 + i]);
  }
  line.pose.rotation = unit(q);
  return line;
}

/// Spreadsheets write a byte order mark before the first line.
std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.substr(0, kMark.size()) == kMark ? bytes.substr(kMark.size()) : bytes;
}

/// `"a"`, or `"a" or "b"`.
std::string any_of(const std::vector<std::string>& headers) {
  std::string text;
  for (const std::string& header : headers)
    text += (text.empty() ? "" : " or ") + in_quotes(header);
  return text;
}

}  // namespace

DatasetNames::DatasetNames(const std::vector<Scene>& scenes) {
  for (const Scene& scene : scenes) {
    scenes_.push_back(scene.name);
    for (const SensorScan& scan : scene.sensors) sensors_[scene.name].push_back(scan.sensor);
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
  const std::string bytes = read_whole_file(path);
  const std::string file = path.string();
  LineReader reader(without_byte_order_mark(bytes));
  if (!reader.next() || std::find(headers.begin(), headers.end(), reader.line()) == headers.end()) {
    throw InputError(file, "line 1",
                     "expected " + any_of(headers) + ", found " + in_quotes(reader.line()));
  }
  const bool has_trial = reader.line() == kStartHeader;
  std::vector<Fault> faults;
  std::size_t more = 0;
  while (reader.next()) {
    const bool is_shown = faults.size() < kShownFaults;
    try {
      const PoseLine line = read_line(std::string(reader.line()), has_trial);
      if (!is_shown && !names.has(line.scene, line.sensor)) {
        ++more;
        continue;
      }
      names.check(line.scene, line.sensor);
      add(line);
    } catch (const InputError& error) {
      if (is_shown) faults.push_back({file, reader.place(), error.faults().front().message});
      if (!is_shown) ++more;
    }
  }
  if (!faults.empty()) throw_first(std::move(faults), file, more);
  return sha256_of_text(bytes);
}

void throw_first(std::vector<Fault> faults, const std::string& file, std::size_t more) {
  if (faults.size() > kShownFaults) {
    more += faults.size() - kShownFaults;
    faults.resize(kShownFaults);
  }
  if (more > 0) faults.push_back({file, "", "and " + std::to_string(more) + " more faults"});
  throw InputError(std::move(faults));
}

std::filesystem::path found_input(const Experiment& experiment, const std::string& name,
                                  const std::filesystem::path& data_root, const Fault& at,
                                  const std::string& what) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(experiment.file).parent_path();
  std::string found;
  for (const fs::path& folder : {data_root, beside.empty() ? fs::path(".") : beside}) {
    const fs::path path = folder / name;
    std::error_code error;
    if (fs::is_regular_file(path, error)) {
      if (is_within(fs::canonical(path, error), fs::canonical(folder, error))) return path;
      found = path.string() + ", which is outside the folder " + folder.string();
    }
  }
  if (found.empty()) {
    found = "neither " + (data_root / name).string() + " nor " + (beside / name).string();
  }
  throw InputError(at.file, at.where, "expected " + what + ", found " + found);
}

}  // namespace croon::experiments
