#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/run/scene_groups.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// A start, and the variants to run from it.
struct PlannedStart {
  std::size_t scene = 0;   ///< Index in the list of groups.
  std::size_t sensor = 0;  ///< Index in SceneGroup::pairs.
  int trial = 0;
  std::size_t variants = 0;  ///< Index in Plan::variants.
};

/// The trials to run. Starts for which the same variants are still to be run share one list.
struct Plan {
  std::vector<std::vector<std::size_t>> variants;  ///< Lists of indices in Experiment::variants.
  std::vector<PlannedStart> starts;                ///< By scene, sensor, trial.
  std::size_t trials = 0;                          ///< Every start counts once per variant.
};

/// Part `part` of `parts` of the trials: a block of the list of (scene, trial). A shard therefore
/// needs few scenes, and has all variants and sensors of its trials.
struct Shard {
  int part = 1;
  int parts = 1;
};

/// The part of an experiment to run.
struct Selection {
  std::vector<std::size_t> variants;  ///< Indices in Experiment::variants.
  Shard shard;
};

/// Parses a shard, "2/8". Throws InputError unless it is K/N with 1 <= K <= N.
Shard read_shard(const std::string& text);

/// The indices of the variants that `names` select; all if `names` is empty. A name selects the
/// variant or, if there is a grid, all of its points. Throws InputError, with the nearest name, if
/// a name selects nothing.
std::vector<std::size_t> select_variants(const Experiment& experiment,
                                         const std::vector<std::string>& names);

/// Throws InputError, with an estimate, if the trials of `selection` do not fit into memory.
void check_plan_size(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                     const Selection& selection);

/// The trials of `selection` that are missing in the sorted list `done`, whose indices refer to
/// Experiment::variants, `groups` and sensor_names(groups).
Plan plan_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                 const Selection& selection, const std::vector<TrialIndex>& done = {});

/// The distinct names of the pairs of all groups, in the order of their first groups.
std::vector<std::string> sensor_names(const std::vector<SceneGroup>& groups);

}  // namespace croon::experiments
