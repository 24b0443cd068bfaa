#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/engine/experiment.hpp"
#include "experiments/engine/trial_record.hpp"

namespace croon::experiments {

/// A trial by its places in Experiment::variants, the list of scenes and Scene::sensors.
struct PlannedTrial {
  std::size_t scene = 0;
  std::size_t variant = 0;
  std::size_t sensor = 0;
  int trial = 0;
};

/// Part `part` of `parts` of the trials: those with `trial % parts == part - 1`.
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

/// The trials of `selection` in the order in which they are run: by scene, sensor, trial, variant.
std::vector<PlannedTrial> plan_trials(const Experiment& experiment,
                                      const std::vector<Scene>& scenes, const Selection& selection);

/// What `planned` is called.
TrialId trial_id(const Experiment& experiment, const std::vector<Scene>& scenes,
                 const PlannedTrial& planned);

/// Sorts records into the order of every output: variants as in the experiment, scenes and sensors
/// as in the dataset, then trials. Records of anything else are dropped.
std::vector<TrialRecord> in_report_order(const std::vector<TrialRecord>& records,
                                         const Experiment& experiment,
                                         const std::vector<Scene>& scenes);

}  // namespace croon::experiments
