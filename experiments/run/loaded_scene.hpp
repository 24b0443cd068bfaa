#pragma once

#include <optional>
#include <vector>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/calibration/loaded_scene.hpp"

namespace croon::experiments {

/// The clouds of `pair`; std::nullopt if the scene lacks one of its sensors.
struct CloudPair {
  const LoadedScan* target = nullptr;
  const LoadedScan* source = nullptr;
};
std::optional<CloudPair> cloud_pair(const LoadedScene& loaded, const SensorPair& pair);

/// The times of computations done once per cloud.
std::vector<TimingRow> scene_timings(const LoadedScene& loaded);

}  // namespace croon::experiments
