#pragma once

#include <cstddef>
#include <vector>

#include "experiments/analysis/paired_values.hpp"
#include "experiments/analysis/trial_summary.hpp"

namespace croon::experiments {

/// The trials that both of two variants have, pair by pair.
struct PairedTrials {
  std::vector<std::size_t> scenes;  ///< The index of each pair's scene.
  Pairs rotation_deg;               ///< Errors; infinite if the trial has no usable result.
  Pairs translation_m;
  std::vector<double> success;  ///< 1 where the variant alone won, -1 where the base did, else 0.
};

/// The trials of one variant on one sensor of one scene.
struct SceneTrials {
  const SceneRecords& records;
  const SceneSummary& summary;
};

/// Adds the trials that both sides have; `scene` is the index of their scene.
void add_pairs(PairedTrials& to, std::size_t scene, const SceneTrials& base,
               const SceneTrials& variant, const PoseBounds& bounds);

/// Adds all pairs of `from`.
void append(PairedTrials& to, const PairedTrials& from);

}  // namespace croon::experiments
