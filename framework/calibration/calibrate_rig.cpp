#include "framework/calibration/calibrate_rig.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/calibration/composition.hpp"
#include "framework/calibration/error_budget.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/calibration/ground_pose.hpp"
#include "framework/calibration/rig_run.hpp"
#include "framework/calibration/scan_fault_checks.hpp"
#include "framework/calibration/scene_clouds.hpp"
#include "framework/calibration/sensor_result.hpp"
#include "framework/calibration/warnings.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/motion.hpp"

namespace croon {
namespace {

/// Approximate share of the time spent on reading, for progress reports.
constexpr double kReadingShare = 0.2;

/// One sensor in one scene: its member of the rig, or the reason why it has none.
struct Part {
  std::string scene, sensor;
  std::size_t member = 0;  ///< Valid if `why_not` is empty.
  std::string why_not;
};

/// The members that are calibrated together.
struct RigInput {
  std::vector<CalibrationMember> members;
  std::vector<Part> parts;  ///< By scene, then by sensor.
};

/// Throws InputError if the scenes are not of one rig.
void check_scenes(const std::vector<Scene>& scenes) {
  if (scenes.empty()) throw InputError("", "", "expected at least one scene, found none");
  for (const Scene& scene : scenes) {
    if (scene.reference.sensor == scenes.front().reference.sensor) continue;
    throw InputError("", "scene " + scene.name,
                     "expected the reference \"" + scenes.front().reference.sensor +
                         "\" in all scenes, found \"" + scene.reference.sensor + "\"");
  }
}

/// The maximum distances from a nominal pose at which a sensor is searched for.
PoseBounds nominal_bounds(const CalibrationOptions& options) {
  constexpr double kStds = 3.0;
  return {rad_from_deg(kStds * options.nominal_std_deg), kStds * options.nominal_std_m};
}

Composition chosen_composition(const CalibrationOptions& options, const Catalogue& catalogue) {
  const CompositionOptions adapted = {nominal_bounds(options), options.at_rest};
  return options.pipeline_text.empty()
             ? composition_called(options.pipeline, adapted, catalogue)
             : composition_in_text(options.pipeline_text, options.pipeline, adapted, catalogue);
}

/// How the steps of `composition` treat motion, if they depend on the times; otherwise empty.
std::string treatment_of_motion(const Composition& composition,
                                const std::vector<SceneClouds>& scenes, bool at_rest) {
  if (at_rest) return "the vehicle is said to stand, so no motion is looked for";
  if (composition.channels.count(kTime) == 0 || composition.source_channels.count(kTime) > 0) {
    return "";
  }
  const std::string doubt = why_times_are_in_doubt(scenes);
  return doubt.empty() ? "the times of all clouds are usable, so the vehicle's motion is estimated"
                       : doubt +
                             ", so motion is not corrected there; scenes in which it would affect "
                             "poses are rejected";
}

/// The clouds for the steps of `composition`, moved out of `scenes`.
RigInput rig_input(std::vector<SceneClouds>& scenes, const Composition& composition,
                   std::uint64_t seed, std::vector<std::string>& unused) {
  RigInput input;
  for (SceneClouds& clouds : scenes) {
    const Scene& scene = *clouds.scene;
    std::vector<std::string> why_not(scene.sensors.size(), clouds.why_unused);
    for (std::size_t i = 0; i < scene.sensors.size() && clouds.why_unused.empty(); ++i) {
      const ReadScan& scan = clouds.sensors[i];
      if (!scan.is_usable()) {
        why_not[i] = scan.unavailable ? scan.unavailable->line() : scan.failure;
        continue;
      }
      why_not[i] = why_not_for(composition, clouds, i);
      if (!why_not[i].empty()) unused.push_back("Scene " + scene.name + ": " + why_not[i] + ".");
    }
    std::shared_ptr<const Cloud> target;
    for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
      const SensorScan& scan = scene.sensors[i];
      input.parts.push_back({scene.name, scan.sensor, input.members.size(), why_not[i]});
      if (!why_not[i].empty()) continue;
      const auto cloud = [&](ReadScan& read, const std::string& sensor) {
        return loaded_scan(std::move(read), scene.name, sensor, seed, composition.channels).cloud;
      };
      if (!target) target = cloud(clouds.reference, scene.reference.sensor);
      input.members.push_back({scene.name, scene.reference.sensor, scan.sensor, target,
                               cloud(clouds.sensors[i], scan.sensor), scan.nominal});
    }
  }
  return input;
}

/// The results of the sensors, in the order of `names`.
std::vector<CalibratedSensor> sensor_results(const RigInput& input,
                                             const std::vector<MemberResult>& results,
                                             const std::vector<std::string>& names) {
  std::vector<CalibratedSensor> sensors;
  for (const std::string& name : names) {
    std::vector<SceneResult> scenes;
    for (const Part& part : input.parts) {
      if (part.sensor != name) continue;
      const MemberResult* const result = part.why_not.empty() ? &results[part.member] : nullptr;
      scenes.push_back({part.scene, result, part.why_not});
    }
    sensors.push_back(sensor_result(name, scenes));
  }
  return sensors;
}

std::size_t accepted_of(const std::vector<CalibratedSensor>& sensors) {
  return static_cast<std::size_t>(
      std::count_if(sensors.begin(), sensors.end(),
                    [](const CalibratedSensor& sensor) { return sensor.is_accepted; }));
}

/// The results of the sensors, and of their members in single scenes.
struct Outcome {
  std::vector<CalibratedSensor> sensors;
  std::vector<MemberResult> members;
  std::vector<std::string> warnings;
};

/// Sets the nominal poses as initial guesses of the members of rejected sensors. Returns whether
/// there was any.
bool start_near_nominal(std::vector<CalibrationMember>& members, const RigInput& input,
                        const std::vector<CalibratedSensor>& sensors) {
  bool is_any = false;
  for (const CalibratedSensor& sensor : sensors) {
    if (sensor.is_accepted) continue;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (members[i].sensor != sensor.sensor || !input.members[i].start) continue;
      members[i].start = input.members[i].start;
      is_any = true;
    }
  }
  return is_any;
}

/// Calibrates without initial guesses, so that a wrong nominal pose cannot hide a rival; rejected
/// sensors are tried again near their nominal poses. If that does not help, the first result and
/// its reasons stay: the nominal pose may be wrong.
Outcome outcome_of(const Composition& composition, const RigInput& input,
                   const std::vector<std::string>& names, std::uint64_t seed,
                   const StepProgress& progress) {
  std::vector<CalibrationMember> members = input.members;
  for (CalibrationMember& member : members) member.start.reset();
  Outcome outcome;
  outcome.members = run_rig(composition, members, seed, progress);
  outcome.sensors = sensor_results(input, outcome.members, names);
  if (!start_near_nominal(members, input, outcome.sensors)) return outcome;
  Outcome again;
  again.members = run_rig(composition, members, seed, progress);
  again.sensors = sensor_results(input, again.members, names);
  if (accepted_of(again.sensors) <= accepted_of(outcome.sensors)) return outcome;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (outcome.sensors[i].is_accepted || !again.sensors[i].is_accepted) continue;
    again.warnings.push_back(printable(names[i]) +
                             " is accepted near its nominal pose only; poses farther from it were "
                             "not ruled out");
  }
  return again;
}

/// Computes the pose of the reference above the road and the heading of the rig.
void set_ground(CalibratedRig& rig, const RigInput& input, std::uint64_t seed) {
  std::vector<const Points*> references;
  for (const CalibrationMember& member : input.members) {
    const Points* const points = &member.target->points();
    if (references.empty() || references.back() != points) references.push_back(points);
  }
  Rng rng(StreamKey(seed).with("ground"));
  rig.ground = ground_pose(references, rng);
  rig.heading = heading_of_travel(rig.motion, rig.ground);
}

/// Lists in `unused` the scenes in which no sensor has a pose because a step failed.
void add_failed_scenes(const RigInput& input, const std::vector<MemberResult>& results,
                       std::vector<std::string>& unused) {
  for (std::size_t begin = 0; begin < input.members.size();) {
    const std::string& scene = input.members[begin].scene;
    std::size_t end = begin;
    bool is_any_usable = false;
    for (; end < input.members.size() && input.members[end].scene == scene; ++end) {
      is_any_usable = is_any_usable || results[end].failure.empty();
    }
    if (!is_any_usable) {
      unused.push_back("Scene " + scene + ": no sensor has a pose; " + results[begin].failure +
                       ".");
    }
    begin = end;
  }
}

/// The velocity that the steps estimated in each scene.
std::vector<SceneMotionEstimate> motion_of(const RigInput& input,
                                           const std::vector<MemberResult>& results) {
  std::vector<SceneMotionEstimate> motion;
  for (std::size_t i = 0; i < input.members.size(); ++i) {
    const Extras& extras = results[i].estimate.extras;
    const Twist* const velocity = extras.find(kMotion);
    if (velocity == nullptr || !results[i].failure.empty()) continue;
    if (!motion.empty() && motion.back().scene == input.members[i].scene) continue;
    motion.push_back({input.members[i].scene, *velocity});
    const Matrix6d* const covariance = extras.find(kMotionCovariance);
    if (covariance != nullptr) motion.back().covariance = *covariance;
  }
  return motion;
}

/// The best pose that a global search found away from the result; std::nullopt without any.
std::optional<RigidTransform> rival_of(const MemberResult& result) {
  const std::vector<Hypothesis>* const found = result.estimate.extras.find(kHypotheses);
  if (found == nullptr) return std::nullopt;
  for (const Hypothesis& other : *found) {
    if (!agree(other.T_target_source, result.T_in_scene, kSameHypothesis)) {
      return other.T_target_source;
    }
  }
  return std::nullopt;
}

/// The scene that reports show and the fit check uses, with its clouds after the last step: that
/// with the most accepted poses, because motion may be removed wrongly from the clouds of others;
/// of several, that with the most sensors.
ShownScene shown_scene(const RigInput& input, const std::vector<MemberResult>& results) {
  ShownScene shown;
  std::pair<std::size_t, std::size_t> most;
  for (std::size_t begin = 0; begin < input.members.size();) {
    ShownScene scene{input.members[begin].scene, results[begin].estimate.target, {}};
    std::size_t accepted = 0;
    for (; begin < input.members.size() && input.members[begin].scene == scene.scene; ++begin) {
      const MemberResult& result = results[begin];
      accepted += result.is_accepted() ? 1 : 0;
      scene.sensors.push_back(
          {input.members[begin].sensor, result.estimate.source, result.path, rival_of(result)});
    }
    const std::pair<std::size_t, std::size_t> count = {accepted, scene.sensors.size()};
    if (count <= most) continue;
    most = count;
    shown = std::move(scene);
  }
  return shown;
}

void set_nominal(std::vector<CalibratedSensor>& sensors, const std::vector<Scene>& scenes) {
  for (CalibratedSensor& sensor : sensors) {
    for (const Scene& scene : scenes) {
      const std::size_t i = index_of(scene, sensor.sensor);
      if (i < scene.sensors.size() && !sensor.nominal) sensor.nominal = scene.sensors[i].nominal;
    }
  }
}

/// Throws InputError, with the reasons, if nothing can be calibrated.
void require_members(const RigInput& input, const std::vector<std::string>& unused) {
  if (!input.members.empty()) return;
  std::vector<Fault> faults = {
      {"", "", "expected a scene with usable clouds of the reference and of another sensor"}};
  for (const std::string& reason : unused) faults.push_back({"", "", reason});
  throw InputError(std::move(faults));
}

/// The notes about single clouds, each once per sensor.
std::vector<std::string> notes_on(const std::vector<NamedCloud>& clouds) {
  std::vector<std::string> notes;
  for (const NamedCloud& named : clouds) {
    for (const std::string& note : named.cloud->notes) {
      const std::string line = named.sensor + ": " + note;
      if (std::find(notes.begin(), notes.end(), line) == notes.end()) notes.push_back(line);
    }
  }
  return notes;
}

CalibratedRig calibrated(const std::vector<Scene>& scenes, const CalibrationOptions& options,
                         const Composition& composition) {
  const auto progress = [&](const std::string& what, double done) {
    if (options.on_progress) options.on_progress(what, done);
  };
  CalibratedRig rig;
  rig.reference = scenes.front().reference.sensor;
  std::size_t read = 0;
  std::vector<SceneClouds> clouds = read_scenes(scenes, [&](const std::string& scene) {
    const double share = static_cast<double>(++read) / static_cast<double>(scenes.size());
    progress("reading " + scene, kReadingShare * share);
  });
  rig.unused = set_aside_unusable(clouds);
  rig.warnings = notes_on(named_clouds(clouds));
  const std::vector<std::string> about_clouds = warnings_about_clouds(named_clouds(clouds));
  rig.warnings.insert(rig.warnings.end(), about_clouds.begin(), about_clouds.end());
  rig.composition = composition.name;
  rig.composition_reason = treatment_of_motion(composition, clouds, options.at_rest);
  add_notes(composition.from_nothing, rig.notes);
  RigInput input = rig_input(clouds, composition, options.seed, rig.unused);
  require_members(input, rig.unused);
  if (options.from_scratch) {
    for (CalibrationMember& member : input.members) member.start.reset();
  }
  const std::vector<std::string> names = sensor_names(scenes);
  const auto step_progress = [&](const std::string& step, double done) {
    progress(step, kReadingShare + (1.0 - kReadingShare) * done);
  };
  Outcome outcome = outcome_of(composition, input, names, options.seed, step_progress);
  add_failed_scenes(input, outcome.members, rig.unused);
  rig.motion = motion_of(input, outcome.members);
  rig.shown = shown_scene(input, outcome.members);
  rig.sensors = std::move(outcome.sensors);
  reject_scan_faults(rig, input.members, outcome.members);
  set_refits(rig);
  add_error_budget(rig, input.members, outcome.members);
  set_nominal(rig.sensors, scenes);
  set_ground(rig, input, options.seed);
  rig.warnings.insert(rig.warnings.end(), outcome.warnings.begin(), outcome.warnings.end());
  const std::vector<std::string> about_rig = warnings_about_rig(rig);
  rig.warnings.insert(rig.warnings.end(), about_rig.begin(), about_rig.end());
  progress("done", 1.0);
  return rig;
}

}  // namespace

CalibratedRig calibrate_rig(const std::vector<Scene>& scenes, const CalibrationOptions& options,
                            const Catalogue& catalogue) {
  check_scenes(scenes);
  const Composition composition = chosen_composition(options, catalogue);
  std::optional<CalibratedRig> rig;
  on_threads(options.jobs > 0 ? options.jobs : tbb::info::default_concurrency(),
             [&] { rig = calibrated(scenes, options, composition); });
  return std::move(*rig);
}

}  // namespace croon
