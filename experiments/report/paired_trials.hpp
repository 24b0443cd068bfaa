#pragma once

#include <cstddef>
#include <vector>

#include "experiments/report/scene_summary.hpp"
#include "experiments/statistics/pairs.hpp"

namespace croon::experiments {

/// The trials that two variants both have, pair by pair.
struct PairedTrials {
  std::vector<std::size_t> scenes;  ///< The number of each pair's scene.
  Pairs rotation_deg;               ///< Errors; infinite where the trial has no usable result.
  Pairs translation_m;
  std::vector<double> success;  ///< 1 where the variant alone won, -1 where the base did, else 0.
};

/// What one variant did on one sensor of one scene.
struct SceneTrials {
  const SceneRecords& records;
  const SceneSummary& summary;
};

/// Adds the trials that both sides have; `scene` is the number of their scene.
void add_pairs(PairedTrials& to, std::size_t scene, const SceneTrials& base,
               const SceneTrials& variant, const PoseBounds& bounds);

/// Adds all pairs of `from`.
void append(PairedTrials& to, const PairedTrials& from);

}  // namespace croon::experiments
