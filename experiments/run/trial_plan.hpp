#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/run/scene_groups.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// One start, and the variants that are to run from it.
struct PlannedStart {
  std::size_t scene = 0;   ///< Index in the list of groups.
  std::size_t sensor = 0;  ///< Index in SceneGroup::pairs.
  int trial = 0;
  std::size_t variants = 0;  ///< Index in Plan::variants.
};

/// What is to be run. Starts that miss the same variants share a list of them.
struct Plan {
  std::vector<std::vector<std::size_t>> variants;  ///< Lists of indices in Experiment::variants.
  std::vector<PlannedStart> starts;                ///< By scene, sensor, trial.
  std::size_t trials = 0;                          ///< Starts, each with its variants.
};

/// Part `part` of `parts` of the trials: a block of the list of (scene, trial). So a shard needs
/// few scenes, and has all variants and sensors of a trial.
struct Shard {
  int part = 1;
  int parts = 1;
};

/// The part of an experiment that is to be run.
struct Selection {
  std::vector<std::size_t> variants;  ///< Indices in Experiment::variants.
  Shard shard;
};

/// The shard that `text` names, "2/8". Throws InputError unless it is K/N with 1 <= K <= N.
Shard read_shard(const std::string& text);

/// The indices of the variants that `names` select; all if it is empty. A name selects the variant
/// and, if there is a grid, all of its points. Throws InputError, with the nearest name, if a name
/// selects nothing.
std::vector<std::size_t> select_variants(const Experiment& experiment,
                                         const std::vector<std::string>& names);

/// Throws InputError, with an estimate, if the trials of `selection` do not fit into memory.
void check_plan_size(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                     const Selection& selection);

/// The trials of `selection` that are not in `done`, which is sorted. Its indices are those in
/// Experiment::variants, `groups` and sensor_names(groups).
Plan plan_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                 const Selection& selection, const std::vector<TrialIndex>& done = {});

/// The names of the pairs of all groups, each once, in the order of their first group.
std::vector<std::string> sensor_names(const std::vector<SceneGroup>& groups);

}  // namespace croon::experiments
