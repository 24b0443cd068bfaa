#include "experiments/run/starts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "experiments/file/start_rule.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/rng.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/rigid_transform.hpp"
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

/// The centres that `pair` has, for the message.
std::string centres_of(const CalibratedPair& pair) {
  std::string known;
  for (const auto& [word, centre] : kStartCentres) {
    if (!centre_pose(centre, pair)) continue;
    known += (known.empty() ? "\"" : ", \"") + word + "\"";
  }
  return known.empty() ? "it has no poses: truth.json or nominal.json gives the poses of a "
                         "recording by sensor name, and \"starts\": \"none\" needs no "
                         "pose"
                       : "it has " + known;
}

/// The scenes in which one sensor has no pose to draw starts around.
struct MissingPose {
  std::vector<std::string> scenes;
  std::string instead;
};

/// The pose among `unused` whose name is most similar to `sensor`; null if none is similar.
const UnusedPose* misspelt(const std::string& sensor, const std::vector<UnusedPose>& unused) {
  std::vector<std::string> names;
  for (const UnusedPose& pose : unused) names.push_back(pose.sensor);
  const std::string near = nearest_name(sensor, names);
  if (near.empty()) return nullptr;
  return &*std::find_if(unused.begin(), unused.end(),
                        [&](const UnusedPose& pose) { return pose.sensor == near; });
}

std::string scene_list(const std::vector<std::string>& scenes) {
  constexpr std::size_t kShown = 3;
  std::string text = scenes.size() == 1 ? "scene " : "scenes ";
  for (std::size_t i = 0; i < scenes.size() && i < kShown; ++i) {
    text += (i == 0 ? "" : ", ") + scenes[i];
  }
  if (scenes.size() > kShown) text += " and " + std::to_string(scenes.size() - kShown) + " more";
  return text;
}

/// Poses under a name that no sensor has.
struct MisspeltPose {
  std::string sensor;  ///< The sensor that was probably meant.
  std::string kind;    ///< The kind of pose that this sensor lacks.
  std::vector<std::string> scenes;
};

/// Throws InputError, with a line per name, if the name of a pose resembles that of a sensor
/// without one: otherwise the pose would be silently ignored.
void check_names(const std::vector<SceneGroup>& groups) {
  std::set<std::string> sensors;
  for (const SceneGroup& group : groups) {
    for (const SensorPair& pair : group.pairs) sensors.insert(pair.name);
  }
  std::map<std::pair<std::string, std::string>, MisspeltPose> found;  // By file and name.
  for (const SceneGroup& group : groups) {
    const Scene& first = group.scenes.front();
    for (const CalibratedPair& pair : group.pairs) {
      const auto look = [&](bool has_pose, const std::vector<UnusedPose>& unused,
                            const std::string& kind) {
        if (has_pose) return;
        const UnusedPose* const pose = misspelt(pair.name, unused);
        if (pose == nullptr || sensors.count(pose->sensor) > 0) return;
        MisspeltPose& of_name = found[{pose->file, pose->sensor}];
        of_name.sensor = pair.name;
        of_name.kind = kind;
        of_name.scenes.push_back(group.name);
      };
      look(pair.truth.has_value(), first.unused_truth, "true");
      look(pair.nominal.has_value(), first.unused_nominal, "nominal");
    }
  }
  std::vector<Fault> faults;
  for (const auto& [position, pose] : found) {
    const auto& [file, name] = position;
    faults.push_back({file, "/" + name,
                      "expected a sensor of " + scene_list(pose.scenes) + ", found " +
                          in_quotes(name) + "; did you mean " + in_quotes(pose.sensor) +
                          ", which has no " + pose.kind + " pose?"});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Throws InputError, with a line per sensor, if a scene lacks the pose to draw starts around.
void check_centres(const Experiment& experiment, const std::vector<SceneGroup>& groups) {
  const StartCentre around = experiment.starts.around;
  std::map<std::string, MissingPose> missing;
  for (const SceneGroup& group : groups) {
    for (const CalibratedPair& pair : group.pairs) {
      if (centre_pose(around, pair)) continue;
      MissingPose& of_sensor = missing[pair.name];
      of_sensor.scenes.push_back(group.name);
      of_sensor.instead = centres_of(pair);
    }
  }
  std::vector<Fault> faults;
  for (const auto& [sensor, poses] : missing) {
    faults.push_back({experiment.starts_file, "/starts/around",
                      "sensor \"" + sensor + "\" has no " + params::word_of(kStartCentres, around) +
                          " pose to draw starts around in " + scene_list(poses.scenes) + "; " +
                          poses.instead});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Collects the lines of a file, in any order.
class StartLines {
 public:
  explicit StartLines(const std::vector<SceneGroup>& groups) {
    for (const SceneGroup& group : groups) {
      for (const SensorPair& pair : group.pairs) starts_[{group.name, pair.name}];
    }
  }

  void add(const PoseLine& line) {
    if (!starts_[{line.scene, line.sensor}].emplace(line.trial, line.pose).second) {
      throw InputError("", "",
                       "expected each trial once, found trial " + std::to_string(line.trial) +
                           " of sensor " + in_quotes(line.sensor) + " in scene " +
                           in_quotes(line.scene) + " again");
    }
    trials_ = std::max(trials_, line.trial + 1);
  }

  /// The starts, the same number for each sensor. Notes a fault for each sensor with missing
  /// starts.
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
  std::map<std::pair<std::string, std::string>, std::map<int, Start>> starts_;
  int trials_ = 0;
};

}  // namespace

const std::optional<RigidTransform>& centre_pose(StartCentre around, const CalibratedPair& pair) {
  if (around == StartCentre::nominal) return pair.nominal;
  if (around == StartCentre::initial) return pair.initial;
  return pair.truth;
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
    for (int i = 0; i < 3; ++i) {
      const double range_rad = rad_from_deg(rule.rotation_deg[static_cast<std::size_t>(i)]);
      offset(i) = rng.uniform(-range_rad, range_rad);
    }
  }
  if (length_m) {
    offset.tail<3>() = *length_m * uniform_direction(rng);
  } else {
    for (int i = 0; i < 3; ++i) {
      const double range_m = rule.translation_m[static_cast<std::size_t>(i)];
      offset(3 + i) = rng.uniform(-range_m, range_m);
    }
  }
  const RigidTransform start = moved(rotated, offset);
  return {unit_quaternion(start.rotation), start.translation};
}

Start start_of(const Experiment& experiment, const std::string& scene, const CalibratedPair& pair,
               int trial) {
  const StartRule& rule = experiment.starts;
  if (rule.is_none) return {};
  if (rule.table) {
    return rule.table->starts.at({scene, pair.name}).at(static_cast<std::size_t>(trial));
  }
  return draw_start(rule, centre_pose(rule.around, pair).value(), experiment.seed, scene, pair.name,
                    trial);
}

void resolve_starts(Experiment& experiment, const std::vector<SceneGroup>& groups,
                    const std::filesystem::path& data_root) {
  StartRule& rule = experiment.starts;
  check_names(groups);
  if (rule.is_none) return;
  if (rule.file.empty()) return check_centres(experiment, groups);
  const std::filesystem::path path =
      found_input(experiment, rule.file, data_root, {experiment.starts_file, "/starts/file", ""},
                  "a file of starts");
  rule.table = std::make_shared<const StartTable>(read_start_file(path, groups));
  if (!rule.sha256.empty() && rule.sha256 != rule.table->sha256) {
    throw InputError(
        experiment.starts_file, "/starts/sha256",
        "expected " + rule.sha256 + ", found " + rule.table->sha256 + " of " + path.string());
  }
  rule.sha256 = rule.table->sha256;
  if (rule.trials == 0) rule.trials = rule.table->trials;
  if (rule.trials > rule.table->trials) {
    throw InputError(experiment.starts_file, "/starts/trials",
                     "expected at most " + std::to_string(rule.table->trials) +
                         " trials, as many as " + path.string() + " has, found " +
                         std::to_string(rule.trials));
  }
}

StartTable read_start_file(const std::filesystem::path& path,
                           const std::vector<SceneGroup>& groups) {
  const std::string file = path.string();
  StartLines lines(groups);
  const std::string sha256 = read_pose_file(path, {kStartHeader}, DatasetNames(groups),
                                            [&](const PoseLine& line) { lines.add(line); });
  std::vector<Fault> faults;
  StartTable table = lines.table(file, faults);
  if (table.trials == 0) throw InputError(file, "line 2", "expected a start, found the end");
  if (!faults.empty()) throw_first(std::move(faults), file);
  table.sha256 = sha256;
  return table;
}

}  // namespace croon::experiments
