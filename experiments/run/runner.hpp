#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"

namespace croon::experiments {

/// Who is told of what a run does. Called one at a time, from any thread, in the order of
/// completion.
struct RunListener {
  std::function<void(const std::string& scene)> on_scene;
  /// A trial that is done, with its own timings.
  std::function<void(const TrialRecord&, const std::vector<TimingRow>&)> on_trial;
  /// What was done once for a scene; comes when the scene is done.
  std::function<void(const std::vector<TimingRow>&)> on_scene_timings;
};

/// Runs `plan` on `jobs` threads. The clouds of a scene are read once and let go when it is done;
/// scenes are begun in order, and at most `jobs` + 1 are held at a time. The steps in which the
/// variants of a start begin alike run once, and their time is booked to each of them. A record
/// depends on (experiment, scene, variant, sensor, trial) alone. A cloud that cannot be read, or is
/// empty, and a stage that cannot go on make trials `failed`; a std::logic_error ends the run.
void run_trials(const Experiment& experiment, const std::vector<Scene>& scenes, const Plan& plan,
                int jobs, const RunListener& listener);

}  // namespace croon::experiments
