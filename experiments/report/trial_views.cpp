#include "experiments/report/trial_views.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/report/named_trials.hpp"
#include "experiments/report/volume_chart.hpp"
#include "experiments/run/loaded_scene.hpp"
#include "experiments/run/scene_groups.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/store/input_files.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/loaded_scene.hpp"
#include "framework/io/text_scan.hpp"

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
  bool is_requested = false;  ///< The reader named it, so it must not be left out.
};

bool is_pose_accepted(const TrialRecord& record) {
  return record.status != Status::rejected && record.status != Status::failed;
}

/// The element of `list` with this name; null if there is none.
template <class Named>
const Named* element_called(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Named& element) { return element.name == name; });
  return found == list.end() ? nullptr : &*found;
}

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

/// The trials called `names`, then the chosen ones that are not among them.
std::vector<ChosenTrial> shown_trials(const Results& results,
                                      const std::vector<std::string>& names) {
  std::vector<ChosenTrial> shown;
  for (const TrialRecord* record : trials_called(names, results.records)) {
    shown.push_back({"The trial " + trial_name(record->id), record, true});
  }
  for (ChosenTrial& chosen : chosen_trials(results)) {
    const auto same = std::find_if(shown.begin(), shown.end(), [&](const ChosenTrial& other) {
      return other.record == chosen.record;
    });
    if (same == shown.end()) {
      shown.push_back(std::move(chosen));
    } else {
      same->why += ". " + chosen.why;
    }
  }
  return shown;
}

/// A scene of the group with both sensors of the pair; null if there is none.
const Scene* scene_of(const SceneGroup& group, const SensorPair& pair) {
  for (const Scene& scene : group.scenes) {
    const auto has = [&](const std::string& sensor) {
      return scene.reference.sensor == sensor || index_of(scene, sensor) < scene.sensors.size();
    };
    if (has(pair.source) && has(pair.target)) return &scene;
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

/// The poses of the trial that can be shown, by state; a trial that failed has no result.
std::pair<std::vector<std::string>, std::vector<std::optional<RigidTransform>>> shown_poses(
    const Start& start, const CalibratedPair& pair, const TrialRecord& record) {
  std::vector<std::string> states = {"initial guess"};
  std::vector<std::optional<RigidTransform>> poses = {start};
  if (pair.truth) {
    states.emplace_back("ground truth");
    poses.push_back(pair.truth);
  }
  if (record.T_reference_sensor) {
    states.emplace_back("result");
    poses.push_back(record.T_reference_sensor);
  }
  return {states, poses};
}

/// The view of a trial, or why there is none.
struct ViewOrReason {
  std::optional<TrialView> view;
  std::string why_not;
};

ViewOrReason viewed(const Experiment& experiment, const SceneGroup& group,
                    const CalibratedPair& pair, const ChosenTrial& chosen) {
  const Scene* const scene = scene_of(group, pair);
  if (scene == nullptr) return {{}, "no scene of its group has clouds of both sensors"};
  const LoadedScene loaded = load_scene(*scene, {pair.source, pair.target}, experiment.seed, {});
  const std::vector<Fault> unavailable = unavailable_clouds(loaded);
  if (!unavailable.empty()) throw InputError(unavailable);
  const std::optional<CloudPair> clouds_of_pair = cloud_pair(loaded, pair);
  if (!clouds_of_pair) return {{}, "its sensors are in another order than in the run"};
  for (const LoadedScan* scan : {clouds_of_pair->target, clouds_of_pair->source}) {
    if (!scan->cloud) return {{}, scan->failure};
  }
  const std::shared_ptr<const Cloud> target = clouds_of_pair->target->cloud;
  const std::shared_ptr<const Cloud> source = clouds_of_pair->source->cloud;
  const TrialRecord& record = *chosen.record;
  const auto [states, poses] =
      shown_poses(start_of(experiment, group.name, pair, record.id.trial), pair, record);
  const std::vector<ViewedCloud> clouds = {
      {pair.target, target, true, {states.size(), RigidTransform()}},
      {pair.source, source, is_pose_accepted(record), poses}};
  TrialView view{chosen.why, chosen.record, view_of(group.name, states, clouds)};
  if (record.T_reference_sensor) {
    view.charts.push_back(volume_figure(*target, *source, *record.T_reference_sensor, pair.truth));
  }
  return {std::move(view), ""};
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

std::vector<TrialView> trial_views(const Results& results, const std::vector<std::string>& names,
                                   const std::filesystem::path& data_root,
                                   const Catalogue& catalogue) {
  std::vector<TrialView> views;
  const std::vector<ChosenTrial> shown = shown_trials(results, names);
  if (shown.empty()) return views;
  Experiment experiment = stored_experiment(results, catalogue);
  const std::vector<SceneGroup> all = scene_groups(experiment, data_root);
  resolve_starts(experiment, all, data_root);
  std::vector<SceneGroup> groups;
  for (const ChosenTrial& trial : shown) {
    const std::string& scene = trial.record->id.scene;
    const SceneGroup* const group = element_called(all, scene);
    if (group == nullptr) {
      throw InputError("", "scene " + scene, "expected its clouds, found none");
    }
    if (element_called(groups, scene) == nullptr) groups.push_back(*group);
  }
  refuse_changed_inputs(groups, results.manifest, data_root);
  for (const ChosenTrial& trial : shown) {
    const SceneGroup& group = *element_called(groups, trial.record->id.scene);
    const CalibratedPair* const pair = element_called(group.pairs, trial.record->id.sensor);
    ViewOrReason found = pair == nullptr ? ViewOrReason{{}, "its scene no longer has its sensor"}
                                         : viewed(experiment, group, *pair, trial);
    if (found.view) {
      views.push_back(std::move(*found.view));
    } else if (trial.is_requested) {
      throw InputError(
          "", kTrialOption,
          in_quotes(trial_name(trial.record->id)) + " cannot be shown: " + found.why_not);
    }
  }
  return views;
}

}  // namespace croon::experiments
