#include "experiments/run/given_poses.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "experiments/run/pose_file.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// The poses of a file by scene, sensor and trial; -1 stands for all trials.
using PoseTable = std::map<std::tuple<std::string, std::string, int>, RigidTransform>;

/// Sets the pose to that of the trial in a table.
class GivenPoses final : public Step {
 public:
  explicit GivenPoses(PoseTable poses) : poses_(std::move(poses)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const TrialId& trial = estimate.extras.get(kTrialId);
    for (const int number : {trial.trial, -1}) {
      const auto found = poses_.find({trial.scene, trial.sensor, number});
      if (found == poses_.end()) continue;
      estimate.set_pose(found->second);
      return estimate;
    }
    throw StageError("the file has no pose for this trial");
  }

 private:
  PoseTable poses_;
};

/// The step with the poses of a file, and the digest of the file.
struct PosesStep {
  std::shared_ptr<const Step> step;
  std::string sha256;
};

PosesStep read_step(const std::filesystem::path& path, const DatasetNames& names) {
  PoseTable table;
  const std::string sha256 =
      read_pose_file(path, {kStartHeader, kPoseHeader}, names, [&](const PoseLine& line) {
        if (table.emplace(std::tuple(line.scene, line.sensor, line.trial), line.pose).second)
          return;
        throw InputError("", "",
                         "expected each pose once, found sensor " + in_quotes(line.sensor) +
                             " in scene " + in_quotes(line.scene) + " again");
      });
  return {std::make_shared<const GivenPoses>(std::move(table)), sha256};
}

/// Inserts the step before the other steps of `variant`.
void add_step(Variant& variant, const PosesStep& poses) {
  const nlohmann::ordered_json json = {{"step", kPosesStep}, {"sha256", poses.sha256}};
  variant.pipeline.insert(
      variant.pipeline.begin(),
      {kPosesStep, params::Slot<Step>(params::BuiltStage{poses.step, kPosesStep, json.dump()})});
}

}  // namespace

void resolve_poses(Experiment& experiment, const std::vector<SceneGroup>& groups,
                   const std::filesystem::path& data_root) {
  const DatasetNames names(groups);
  std::vector<Fault> faults;
  std::map<std::filesystem::path, PosesStep> steps;  // By the path of the file.
  for (Variant& variant : experiment.variants) {
    if (variant.poses.name.empty()) continue;
    collect_faults(faults, [&] {
      const std::filesystem::path path =
          found_input(experiment, variant.poses.name, data_root,
                      {variant.poses.file, variant.poses.pointer, ""}, "a file of poses");
      if (steps.count(path) == 0) {
        steps[path] = read_step(path, names);
        experiment.files.push_back({variant.poses.name, steps[path].sha256});
      }
      add_step(variant, steps[path]);
    });
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
}

}  // namespace croon::experiments
