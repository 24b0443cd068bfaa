#pragma once

#include <memory>
#include <string>

#include "experiments/engine/experiment.hpp"
#include "experiments/engine/trial_record.hpp"

namespace croon::experiments {

/// One sensor's cloud as a run has it: the cloud, or why there is none.
struct LoadedScan {
  std::shared_ptr<const Cloud> cloud;
  std::string failure;
  double reading_s = 0.0;
};

/// Reads the cloud of `scan`. Its streams of random numbers are named by seed, scene and sensor.
LoadedScan load_scan(const SensorScan& scan, const std::string& scene, std::uint64_t seed);

/// Runs one trial of `id.variant`, whose pipeline is `pipeline`, and says how it ended.
TrialRecord run_trial(const Experiment& experiment, const Pipeline& pipeline, const TrialId& id,
                      const SensorScan& scan, const LoadedScan& target, const LoadedScan& source);

}  // namespace croon::experiments
