#include "experiments/run/starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include "experiments/file/start_rule.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/rng.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// Shoemake 1992: three uniform draws to a unit quaternion, uniform on S^3.
Eigen::Matrix3d uniform_rotation(Rng& rng) {
  const double u1 = rng.uniform();
  const double angle2 = 2.0 * kPi * rng.uniform();
  const double angle3 = 2.0 * kPi * rng.uniform();
  const double r1 = std::sqrt(1.0 - u1), r2 = std::sqrt(u1);
  const Eigen::Quaterniond q(r2 * std::cos(angle3), r1 * std::sin(angle2), r1 * std::cos(angle2),
                             r2 * std::sin(angle3));
  return q.toRotationMatrix();
}

/// Uniform on the unit sphere (Archimedes: the height is uniform).
Eigen::Vector3d uniform_direction(Rng& rng) {
  const double height = rng.uniform(-1.0, 1.0);
  const double angle = 2.0 * kPi * rng.uniform();
  const double radius = std::sqrt(1.0 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// The file of starts, below the data root or beside the experiment.
std::filesystem::path found_file(const Experiment& experiment,
                                 const std::filesystem::path& data_root) {
  const std::filesystem::path below = data_root / experiment.starts.file;
  const std::filesystem::path beside =
      std::filesystem::path(experiment.file).parent_path() / experiment.starts.file;
  for (const std::filesystem::path& path : {below, beside}) {
    if (std::filesystem::is_regular_file(path)) return path;
  }
  throw InputError(
      experiment.file, "/starts/file",
      "expected a file of starts, found neither " + below.string() + " nor " + beside.string());
}

/// Which centres `scan` has, for the message.
std::string centres_of(const SensorScan& scan) {
  std::string known;
  for (const auto& [word, centre] : kStartCentres) {
    if (!centre_pose(centre, scan)) continue;
    known += (known.empty() ? "\"" : ", \"") + word + "\"";
  }
  return known.empty() ? "it has no pose to draw starts around" : "it has " + known;
}

/// The scenes in which one sensor has no pose to draw starts around.
struct MissingPose {
  std::vector<std::string> scenes;
  std::string instead;
};

std::string scene_list(const std::vector<std::string>& scenes) {
  constexpr std::size_t kShown = 3;
  std::string text = scenes.size() == 1 ? "scene " : "scenes ";
  for (std::size_t i = 0; i < scenes.size() && i < kShown; ++i) {
    text += (i == 0 ? "" : ", ") + scenes[i];
  }
  if (scenes.size() > kShown) text += " and " + std::to_string(scenes.size() - kShown) + " more";
  return text;
}

/// Throws InputError, with a line per sensor, if a scene has no pose to draw starts around.
void check_centres(const Experiment& experiment, const std::vector<Scene>& scenes) {
  const StartCentre around = experiment.starts.around;
  std::map<std::string, MissingPose> missing;
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      if (centre_pose(around, scan)) continue;
      missing[scan.sensor].scenes.push_back(scene.name);
      missing[scan.sensor].instead = centres_of(scan);
    }
  }
  std::vector<Fault> faults;
  for (const auto& [sensor, poses] : missing) {
    faults.push_back({experiment.file, "/starts/around",
                      "sensor \"" + sensor + "\" has no " + params::word_of(kStartCentres, around) +
                          " pose to draw starts around in " + scene_list(poses.scenes) + "; " +
                          poses.instead});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

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

const std::optional<RigidTransform>& centre_pose(StartCentre around, const SensorScan& scan) {
  if (around == StartCentre::nominal) return scan.nominal;
  if (around == StartCentre::initial) return scan.initial;
  return scan.truth;
}

Start draw_start(const StartRule& rule, const RigidTransform& centre, std::uint64_t seed,
                 const std::string& scene, const std::string& sensor, int trial) {
  Rng rng(StreamKey(seed).with("start").with(scene).with(sensor).with(
      static_cast<std::uint64_t>(trial)));
  const auto size_of = [&](SweepOf of) -> std::optional<double> {
    if (!rule.sweep || rule.sweep->of != of) return std::nullopt;
    return level_size(*rule.sweep, level_of(*rule.sweep, trial));
  };
  const std::optional<double> angle_deg = size_of(SweepOf::rotation);
  const std::optional<double> length_m = size_of(SweepOf::translation);
  RigidTransform rotated = centre;
  Vector6d offset = Vector6d::Zero();
  if (angle_deg) {
    rotated.rotation =
        rotation_exp(rad_from_deg(*angle_deg) * uniform_direction(rng)) * centre.rotation;
  } else if (rule.rotation_deg == 180.0) {
    rotated.rotation = uniform_rotation(rng) * centre.rotation;
  } else {
    const double range_rad = rad_from_deg(rule.rotation_deg);
    for (int i = 0; i < 3; ++i) offset(i) = rng.uniform(-range_rad, range_rad);
  }
  if (length_m) {
    offset.tail<3>() = *length_m * uniform_direction(rng);
  } else {
    for (int i = 3; i < 6; ++i) offset(i) = rng.uniform(-rule.translation_m, rule.translation_m);
  }
  const RigidTransform start = moved(rotated, offset);
  return {unit_quaternion(start.rotation), start.translation};
}

Start start_of(const Experiment& experiment, const std::string& scene, const SensorScan& scan,
               int trial) {
  const StartRule& rule = experiment.starts;
  if (rule.table) {
    return rule.table->starts.at({scene, scan.sensor}).at(static_cast<std::size_t>(trial));
  }
  return draw_start(rule, centre_pose(rule.around, scan).value(), experiment.seed, scene,
                    scan.sensor, trial);
}

void resolve_starts(Experiment& experiment, const std::vector<Scene>& scenes,
                    const std::filesystem::path& data_root) {
  StartRule& rule = experiment.starts;
  if (rule.file.empty()) return check_centres(experiment, scenes);
  const std::filesystem::path path = found_file(experiment, data_root);
  rule.table = std::make_shared<const StartTable>(read_start_file(path, scenes));
  if (!rule.sha256.empty() && rule.sha256 != rule.table->sha256) {
    throw InputError(
        experiment.file, "/starts/sha256",
        "expected " + rule.sha256 + ", found " + rule.table->sha256 + " of " + path.string());
  }
  rule.sha256 = rule.table->sha256;
  if (rule.trials == 0) rule.trials = rule.table->trials;
  if (rule.trials > rule.table->trials) {
    throw InputError(experiment.file, "/starts/trials",
                     "expected at most " + std::to_string(rule.table->trials) +
                         " trials, as many as " + path.string() + " has, found " +
                         std::to_string(rule.trials));
  }
}

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
