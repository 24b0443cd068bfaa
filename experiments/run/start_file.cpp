#include "experiments/run/start_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kShownFaults = 10;
constexpr std::size_t kFields = 10;
constexpr double kUnitTolerance = 1e-6;

/// A line of a file of starts.
struct StartLine {
  std::string scene;
  std::string sensor;
  int trial = 0;
  Start start;
};

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
StartLine read_start_line(const std::string& text) {
  const std::vector<std::string> fields = fields_of(text);
  if (fields.size() != kFields) {
    refuse(std::to_string(kFields) + " fields", std::to_string(fields.size()));
  }
  StartLine line{fields[0], fields[1], trial_number(fields[2]), {}};
  for (int i = 0; i < 3; ++i) line.start.translation(i) = finite_number(fields[3 + i]);
  Eigen::Quaterniond q;
  for (int i = 0; i < 4; ++i) q.coeffs()(i) = finite_number(fields[6 + i]);
  line.start.rotation = unit(q);
  return line;
}

/// Collects the lines of a file, in any order.
class StartLines {
 public:
  explicit StartLines(const std::vector<Scene>& scenes) {
    for (const Scene& scene : scenes) {
      scenes_.push_back(scene.name);
      for (const SensorScan& scan : scene.sensors) starts_[{scene.name, scan.sensor}];
    }
  }

  void add(const StartLine& line) {
    const auto found = starts_.find({line.scene, line.sensor});
    if (found == starts_.end()) refuse_names(line);
    if (!found->second.emplace(line.trial, line.start).second) {
      refuse("each trial once", "trial " + std::to_string(line.trial) + " of sensor " +
                                    in_quotes(line.sensor) + " in scene " + in_quotes(line.scene) +
                                    " again");
    }
    trials_ = std::max(trials_, line.trial + 1);
  }

  /// The starts, the same number for each sensor. Notes a fault for each sensor that misses one.
  StartTable table(const std::string& file, std::vector<Fault>& faults) const {
    StartTable table;
    table.trials = trials_;
    for (const auto& [names, by_trial] : starts_) {
      std::vector<Start>& starts = table.starts[names];
      for (const auto& [trial, start] : by_trial) {
        if (trial != static_cast<int>(starts.size())) break;
        starts.push_back(start);
      }
      if (static_cast<int>(starts.size()) == trials_) continue;
      faults.push_back({file, "",
                        "expected trials 0 to " + std::to_string(trials_ - 1) + " of sensor " +
                            in_quotes(names.second) + " in scene " + in_quotes(names.first) +
                            ", found no trial " + std::to_string(starts.size())});
    }
    return table;
  }

 private:
  [[noreturn]] void refuse_names(const StartLine& line) const {
    std::vector<std::string> sensors;
    for (const auto& [names, starts] : starts_) {
      if (names.first == line.scene) sensors.push_back(names.second);
    }
    if (sensors.empty()) {
      refuse("a scene of the dataset", in_quotes(line.scene) + name_hint(line.scene, scenes_));
    }
    refuse("a sensor of scene " + in_quotes(line.scene),
           in_quotes(line.sensor) + name_hint(line.sensor, sensors));
  }

  std::vector<std::string> scenes_;
  std::map<std::pair<std::string, std::string>, std::map<int, Start>> starts_;
  int trials_ = 0;
};

/// Spreadsheets write a byte order mark before the first line.
std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.substr(0, kMark.size()) == kMark ? bytes.substr(kMark.size()) : bytes;
}

/// Throws the first faults, and how many more there are.
[[noreturn]] void throw_first(std::vector<Fault> faults, const std::string& file) {
  if (faults.size() > kShownFaults) {
    const std::size_t more = faults.size() - kShownFaults;
    faults.resize(kShownFaults);
    faults.push_back({file, "", "and " + std::to_string(more) + " more faults"});
  }
  throw InputError(std::move(faults));
}

}  // namespace

StartTable read_start_file(const std::filesystem::path& path, const std::vector<Scene>& scenes) {
  const std::string bytes = read_whole_file(path);
  const std::string file = path.string();
  LineReader reader(without_byte_order_mark(bytes));
  if (!reader.next() || reader.line() != kStartHeader) {
    throw InputError(file, "line 1",
                     "expected " + in_quotes(kStartHeader) + ", found " + in_quotes(reader.line()));
  }
  StartLines lines(scenes);
  std::vector<Fault> faults;
  while (reader.next()) {
    try {
      lines.add(read_start_line(std::string(reader.line())));
    } catch (const InputError& error) {
      faults.push_back({file, reader.place(), error.faults().front().message});
    }
  }
  if (!faults.empty()) throw_first(std::move(faults), file);
  StartTable table = lines.table(file, faults);
  if (table.trials == 0) throw InputError(file, "line 2", "expected a start, found the end");
  if (!faults.empty()) throw_first(std::move(faults), file);
  table.sha256 = sha256_of_text(bytes);
  return table;
}

}  // namespace croon::experiments
