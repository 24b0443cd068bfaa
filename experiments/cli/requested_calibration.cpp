#include "experiments/cli/requested_calibration.hpp"

#include <algorithm>

#include "experiments/cli/options.hpp"
#include "framework/base/error.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/calibrate_rig.hpp"
#include "framework/calibration/extrinsics.hpp"
#include "framework/calibration/loaded_scene.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

bool has_pose_of(const Extrinsics& poses, const std::string& sensor) {
  return std::any_of(poses.poses.begin(), poses.poses.end(),
                     [&](const ExtrinsicPose& pose) { return pose.sensor == sensor; });
}

/// Adds the pose of the parent of `poses` if it is one of the sensors `names`, which are those
/// other than the `reference`. If the file names no parent, the only sensor that it lacks is it.
/// Returns what the user must know of that.
std::vector<std::string> add_parent(Extrinsics& poses, const std::string& reference,
                                    const std::vector<std::string>& names,
                                    const std::string& file) {
  const auto add = [&](const std::string& parent) {
    poses.poses.push_back({parent, RigidTransform()});
  };
  if (std::find(names.begin(), names.end(), poses.parent) != names.end()) add(poses.parent);
  if (!poses.parent.empty() || !has_pose_of(poses, reference)) return {};
  std::vector<std::string> lacking;
  for (const std::string& name : names) {
    if (!has_pose_of(poses, name)) lacking.push_back(name);
  }
  if (lacking.size() != 1) return {};
  add(lacking.front());
  return {"The file " + in_quotes(file) + " names no parent frame; it is taken to be " +
          in_quotes(lacking.front()) + ", the only sensor without a pose in it."};
}

bool is_request_file(const std::string& input) { return fs::path(input).extension() == ".json"; }

}  // namespace

CalibrateOptions with_file(const CalibrateOptions& options) {
  const bool has_file = std::any_of(options.inputs.begin(), options.inputs.end(), is_request_file);
  if (!has_file) return options;
  if (options.inputs.size() > 1) {
    throw InputError(options.inputs.back(), "",
                     "expected one file that describes a calibration, without further inputs");
  }
  const RigRequest file = read_rig_request(options.inputs.front());
  CalibrateOptions all = options;
  all.inputs = file.inputs;
  if (all.reference.empty()) all.reference = file.reference;
  if (all.nominal.empty()) all.nominal = file.nominal;
  all.from_scratch = options.from_scratch || file.from_scratch;
  all.at_rest = options.at_rest || file.at_rest;
  if (!all.nominal_std_deg) all.nominal_std_deg = file.nominal_std_deg;
  if (!all.nominal_std_m) all.nominal_std_m = file.nominal_std_m;
  if (all.base.empty()) all.base = file.base;
  if (!all.max_time_gap_s) all.max_time_gap_s = file.max_time_gap_s;
  if (!all.max_scenes) all.max_scenes = file.max_scenes;
  if (all.pipeline.empty()) all.pipeline = file.pipeline;
  if (!all.seed) all.seed = file.seed;
  return all;
}

RecordedScenes scenes_of(const RigRequest& request) {
  RecordingOptions recording;
  recording.reference = request.reference;
  if (request.max_time_gap_s) recording.max_time_gap_s = *request.max_time_gap_s;
  if (request.max_scenes) recording.max_scenes = *request.max_scenes;
  return recorded_scenes(request.inputs, recording);
}

std::vector<std::string> set_nominal(std::vector<Scene>& scenes, const std::string& nominal) {
  if (nominal.empty()) return {};
  std::vector<std::string> missing;
  const std::string& reference = scenes.front().reference.sensor;
  Extrinsics read = read_extrinsics(nominal);
  const std::vector<std::string> names = sensor_names(scenes);
  std::vector<std::string> notes = add_parent(read, reference, names, nominal);
  const Extrinsics poses = in_frame_of_sensor(read, reference, nominal);
  std::vector<std::string> known;
  for (const ExtrinsicPose& pose : poses.poses) known.push_back(pose.sensor);
  for (const std::string& name : names) {
    const auto pose = std::find_if(poses.poses.begin(), poses.poses.end(),
                                   [&](const ExtrinsicPose& one) { return one.sensor == name; });
    if (pose == poses.poses.end()) {
      missing.push_back("has no pose of " + in_quotes(name) +
                        ", which is calibrated without one; it has poses of " + list_text(known));
      continue;
    }
    for (Scene& scene : scenes) {
      const std::size_t i = index_of(scene, name);
      if (i < scene.sensors.size()) scene.sensors[i].nominal = pose->T_parent_sensor;
    }
  }
  if (missing.size() == names.size()) {
    throw InputError(nominal, "",
                     "expected a pose of " + in_quotes(names.front()) + ", found none" +
                         name_hint(names.front(), known));
  }
  for (const std::string& line : missing) {
    notes.push_back("The file " + in_quotes(nominal) + " " + line + ".");
  }
  return notes;
}

CalibratedRig calibrate_with_progress(const CalibrateOptions& options,
                                      const std::vector<Scene>& scenes, const Catalogue& catalogue,
                                      std::ostream& err) {
  constexpr std::size_t kPercent = 100;
  Progress progress(err, progress_style_of_stderr(options.quiet), kPercent);
  std::size_t shown = 0;
  CalibrationOptions how;
  if (!options.pipeline.empty()) how.pipeline = options.pipeline;
  how.from_scratch = options.from_scratch;
  how.at_rest = options.at_rest;
  how.nominal_std_deg = options.nominal_std_deg.value_or(how.nominal_std_deg);
  how.nominal_std_m = options.nominal_std_m.value_or(how.nominal_std_m);
  how.seed = options.seed.value_or(how.seed);
  how.jobs = options.jobs;
  how.on_progress = [&](const std::string& what, double done) {
    const auto percent = static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * kPercent);
    progress.set_scene(what);
    if (percent > shown) progress.advance(percent - shown);
    shown = std::max(shown, percent);
  };
  return calibrate_rig(scenes, how, catalogue);
}

void add_rig_options(CLI::App& command, CalibrateOptions& options) {
  CalibrateOptions& o = options;
  add_text(command, "--reference", o.reference,
           "The sensor that defines the frame; default the first.", "a sensor");
  add_number(command, "--max-time-gap", o.max_time_gap_s, 0.0, 3600.0,
             "Maximum time between the clouds of a scene, s; default 0.05.");
  add_number(command, "--max-scenes", o.max_scenes, 1, 1000,
             "Maximum number of scenes, evenly spaced; default 10.");
  add_text(command, "--pipeline", o.pipeline, "best (default), paper, or a file.", "a pipeline");
  command.add_flag("--at-rest", o.at_rest,
                   "The vehicle stood: times are not used, and no motion is looked for.");
  add_number(command, "--seed", o.seed, std::uint64_t{0}, std::uint64_t{1} << 53U,
             "Seed of the random numbers; default 1.");
  command.add_flag("--quiet", o.quiet, "Do not show progress.");
  add_jobs(command, o.jobs);
}

}  // namespace croon::experiments
