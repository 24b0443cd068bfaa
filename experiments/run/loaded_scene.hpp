#pragma once

#include <optional>
#include <vector>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/calibration/loaded_scene.hpp"

namespace croon::experiments {

/// The clouds of `pair`; std::nullopt if the scene does not have the pair.
struct CloudPair {
  const LoadedScan* target = nullptr;
  const LoadedScan* source = nullptr;
};
std::optional<CloudPair> cloud_pair(const LoadedScene& loaded, const SensorPair& pair);

/// The times of what was done once for the clouds.
std::vector<TimingRow> scene_timings(const LoadedScene& loaded);

}  // namespace croon::experiments
