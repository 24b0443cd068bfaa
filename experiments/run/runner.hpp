#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {

/// Callbacks of a run, called one at a time, from any thread, in the order of completion.
struct RunListener {
  std::function<void(const std::string& scene)> on_scene = [](const std::string&) {};
  /// A trial has finished; with its timings.
  std::function<void(const TrialRecord&, const std::vector<TimingRow>&)> on_trial =
      [](const TrialRecord&, const std::vector<TimingRow>&) {};
  /// A scene has finished; with the timings of computations done once for it.
  std::function<void(const std::vector<TimingRow>&)> on_scene_timings =
      [](const std::vector<TimingRow>&) {};
  /// A cloud of a group is damaged or empty; trials use the other scenes. With the reason.
  std::function<void(const std::string& reason)> on_damaged = [](const std::string&) {};
  /// A cloud cannot be read; its trials are skipped. With the reason.
  std::function<void(const Fault&)> on_unavailable = [](const Fault&) {};
};

/// Runs `plan` on `jobs` threads. The clouds of a scene are read once and released when the scene
/// has finished; scenes start in order, and at most `jobs` + 1 are in memory at a time, or one
/// group and `jobs` more scenes. First steps that variants share run once per start, and their time
/// counts for each variant. A record depends only on (experiment, scene, variant, sensor, trial).
/// If a step sees the whole rig, all sensors of a trial run together, or none if a cloud is not
/// available. Trials are `failed` if a cloud is damaged or empty, or if a stage cannot continue;
/// they are skipped if a cloud is not available (UnavailableFile); a std::logic_error ends the run.
void run_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                const Plan& plan, int jobs, const RunListener& listener);

}  // namespace croon::experiments
