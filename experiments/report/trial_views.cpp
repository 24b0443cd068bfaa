#include "experiments/report/trial_views.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/report/volume_chart.hpp"
#include "experiments/run/loaded_scene.hpp"
#include "experiments/run/scene_groups.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/store/input_files.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/loaded_scene.hpp"

namespace croon::experiments {
namespace {

/// The experiment of the results, with its first variant only.
Experiment stored_experiment(const Results& results, const Catalogue& catalogue) {
  auto keys = nlohmann::ordered_json::parse(results.manifest).at("experiment");
  keys["pipeline"] = keys.at("variants").at(0).at("pipeline");
  for (const char* key : {"variants", "claims", "quoted"}) keys.erase(key);
  return parse_experiment(keys.dump(), "manifest.json", catalogue);
}

/// The size of an error for the choice of trials: in multiples of the success bounds.
double error_size(const TrialRecord& record, const SuccessBounds& bounds) {
  const PoseBounds limits = pose_bounds(bounds);
  return std::max(record.error->rotation_rad / std::max(limits.rotation_rad, 1e-6),
                  record.error->translation_m / std::max(limits.translation_m, 1e-6));
}

/// A chosen trial and the reason.
struct ChosenTrial {
  std::string why;
  const TrialRecord* record = nullptr;
};

std::vector<ChosenTrial> chosen_trials(const Results& results) {
  std::vector<const TrialRecord*> accepted, rejected, failed;
  for (const TrialRecord& record : results.records) {
    if (!record.T_reference_sensor) continue;
    auto& list = record.status == Status::rejected ? rejected
                 : record.status == Status::failed ? failed
                                                   : accepted;
    list.push_back(&record);
  }
  std::vector<const TrialRecord*> judged;
  for (const TrialRecord* record : accepted) {
    if (record->error) judged.push_back(record);
  }
  std::stable_sort(judged.begin(), judged.end(), [&](const TrialRecord* a, const TrialRecord* b) {
    return error_size(*a, results.summary.bounds) > error_size(*b, results.summary.bounds);
  });
  std::vector<ChosenTrial> chosen;
  if (!judged.empty()) {
    chosen.push_back({"The largest error of an accepted pose", judged.front()});
    if (judged.size() > 2) {
      chosen.push_back(
          {"A typical pose: the median error of accepted ones", judged[judged.size() / 2]});
    }
  } else if (!accepted.empty()) {
    chosen.push_back({"An accepted pose", accepted[accepted.size() / 2]});
  }
  if (!rejected.empty()) chosen.push_back({"A rejected pose", rejected[rejected.size() / 2]});
  if (!failed.empty()) chosen.push_back({"A failed trial", failed[failed.size() / 2]});
  return chosen;
}

/// A scene of the group with both sensors of the pair; null if there is none.
const Scene* scene_of(const SceneGroup& group, const CalibratedPair& pair) {
  for (const Scene& scene : group.scenes) {
    const bool has_reference = scene.reference.sensor == pair.target;
    if (has_reference && index_of(scene, pair.source) < scene.sensors.size()) return &scene;
  }
  return nullptr;
}

/// The occupied volume around the pose `T` of a trial.
Chart volume_figure(const Cloud& target, const Cloud& source, const RigidTransform& T,
                    const std::optional<RigidTransform>& truth) {
  std::optional<Vector6d> truth_offset;
  if (truth) truth_offset = pose_error(*truth, T).dof;
  return {
      "The volume in m³ that both clouds occupy, over the offset from the result (at 0) in one "
      "degree of freedom. A minimum beside 0 means that the clouds agree better at another "
      "pose; a flat curve, that the scene hardly constrains this degree of freedom. A wrong "
      "pose can be at a minimum too. Ground truth, if known, is dashed in the panels whose axis "
      "contains it.",
      volume_chart(volume_curves(target.points(), source.points(), T), truth_offset)};
}

std::optional<TrialView> viewed(const Experiment& experiment, const SceneGroup& group,
                                const CalibratedPair& pair, const ChosenTrial& chosen) {
  const Scene* const scene = scene_of(group, pair);
  if (scene == nullptr) return std::nullopt;
  LoadedScene loaded = load_scene(*scene, {pair.source}, experiment.seed, {});
  const std::vector<Fault> unavailable = unavailable_clouds(loaded);
  if (!unavailable.empty()) throw InputError(unavailable);
  const std::shared_ptr<const Cloud> target = loaded.scans.front().cloud;
  const std::shared_ptr<const Cloud> source = loaded.scans[index_of(*scene, pair.source) + 1].cloud;
  if (!target || !source) return std::nullopt;
  const TrialRecord& record = *chosen.record;
  std::vector<std::string> states = {"initial guess"};
  std::vector<std::optional<RigidTransform>> poses = {
      start_of(experiment, group.name, pair, record.id.trial)};
  if (pair.truth) {
    states.emplace_back("ground truth");
    poses.push_back(pair.truth);
  }
  states.emplace_back("result");
  poses.push_back(record.T_reference_sensor);
  const bool is_accepted = record.status != Status::rejected && record.status != Status::failed;
  const std::vector<ViewedCloud> clouds = {
      {pair.target, target, true, {states.size(), RigidTransform()}},
      {pair.source, source, is_accepted, poses}};
  return TrialView{chosen.why,
                   chosen.record,
                   view_of(group.name, states, clouds),
                   {volume_figure(*target, *source, *record.T_reference_sensor, pair.truth)}};
}

/// Throws InputError if a file of the groups differs from that of the run with this manifest.
void refuse_changed_inputs(std::vector<SceneGroup>& groups, const std::string& manifest,
                           const std::filesystem::path& data_root) {
  std::map<std::string, std::string> recorded;
  const nlohmann::json inputs = nlohmann::json::parse(manifest).at("inputs");
  for (const nlohmann::json& input : inputs) {
    recorded[input.at("path").get<std::string>()] = input.at("sha256").get<std::string>();
  }
  for (const InputFile& input :
       record_inputs(groups, data_root, tbb::info::default_concurrency())) {
    const auto found = recorded.find(valid_utf8(input.path));
    if (found != recorded.end() && found->second == input.sha256) continue;
    throw InputError(input.path, "", "has changed since the run");
  }
}

}  // namespace

std::vector<TrialView> trial_views(const Results& results, const std::filesystem::path& data_root,
                                   const Catalogue& catalogue) {
  std::vector<TrialView> views;
  const std::vector<ChosenTrial> chosen = chosen_trials(results);
  if (chosen.empty()) return views;
  Experiment experiment = stored_experiment(results, catalogue);
  const std::vector<SceneGroup> all = scene_groups(experiment, data_root);
  resolve_starts(experiment, all, data_root);
  std::vector<SceneGroup> groups;
  for (const ChosenTrial& trial : chosen) {
    const auto is_it = [&](const SceneGroup& group) {
      return group.name == trial.record->id.scene;
    };
    const auto found = std::find_if(all.begin(), all.end(), is_it);
    if (found == all.end()) {
      throw InputError("", "scene " + trial.record->id.scene, "expected its clouds, found none");
    }
    if (std::none_of(groups.begin(), groups.end(), is_it)) groups.push_back(*found);
  }
  refuse_changed_inputs(groups, results.manifest, data_root);
  for (const ChosenTrial& trial : chosen) {
    for (const SceneGroup& group : groups) {
      if (group.name != trial.record->id.scene) continue;
      for (const CalibratedPair& pair : group.pairs) {
        if (pair.name != trial.record->id.sensor) continue;
        if (std::optional<TrialView> view = viewed(experiment, group, pair, trial)) {
          views.push_back(std::move(*view));
        }
      }
    }
  }
  return views;
}

}  // namespace croon::experiments
