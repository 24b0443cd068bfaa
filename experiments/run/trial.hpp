#pragma once

#include <functional>
#include <memory>
#include <string>

#include "experiments/file/experiment.hpp"
#include "experiments/run/pipeline_tree.hpp"
#include "experiments/run/trial_plan.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// One sensor's cloud, or why it could not be read.
struct LoadedScan {
  std::shared_ptr<const Cloud> cloud;
  std::string failure;
  double reading_s = 0.0;
};

/// Reads the cloud of `scan`. Its random streams are named by seed, scene and sensor.
LoadedScan load_scan(const SensorScan& scan, const std::string& scene, std::uint64_t seed);

/// Runs the start `planned` of `scene` through `tree`, and calls `at_end` with the record of each
/// variant.
void run_start(const Experiment& experiment, const PipelineTree& tree, const Scene& scene,
               const PlannedStart& planned, const LoadedScan& target, const LoadedScan& source,
               const std::function<void(const TrialRecord&)>& at_end);

}  // namespace croon::experiments
