#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// One start: places in the list of scenes and in Scene::sensors, and the variants that are to run
/// from it.
struct PlannedStart {
  std::size_t scene = 0;
  std::size_t sensor = 0;
  int trial = 0;
  std::size_t variants = 0;  ///< Place in Plan::variants.
};

/// What is to be run. Starts that lack the same variants share a list of them.
struct Plan {
  std::vector<std::vector<std::size_t>> variants;  ///< Lists of places in Experiment::variants.
  std::vector<PlannedStart> starts;                ///< By scene, sensor, trial.
  std::size_t trials = 0;                          ///< Starts, each with its variants.
};

/// Part `part` of `parts` of the trials: with the trials of all scenes in one row, a block of it. A
/// shard needs few scenes that way, and all variants and sensors of a trial are in one.
struct Shard {
  int part = 1;
  int parts = 1;
};

/// Which part of an experiment a run is to do.
struct Selection {
  std::vector<std::size_t> variants;  ///< Places in Experiment::variants.
  Shard shard;
};

/// The shard that `text` names, "2/8". Throws InputError unless it is K/N with 1 <= K <= N.
Shard read_shard(const std::string& text);

/// The variants that `names` select, all where it is empty: a name selects the variant, and where a
/// grid multiplied it out all of its points. Throws InputError, with the nearest name, where one
/// selects nothing.
std::vector<std::size_t> select_variants(const Experiment& experiment,
                                         const std::vector<std::string>& names);

/// The trials of `selection` that are not in `done`, which is sorted: places in
/// Experiment::variants, `scenes`, sensor_names(scenes), and the trial.
Plan plan_trials(const Experiment& experiment, const std::vector<Scene>& scenes,
                 const Selection& selection, const std::vector<TrialPlace>& done = {});

/// The sensors of all scenes, each once, as they come.
std::vector<std::string> sensor_names(const std::vector<Scene>& scenes);

}  // namespace croon::experiments
