#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run/trial_plan.hpp"
#include "framework/pipeline/rig.hpp"

namespace croon::experiments {

/// The pipelines of variants as a tree, with common first steps merged: each path from the root is
/// the pipeline of the variants that end there. Each step of the tree runs once per start,
/// regardless of the number of variants that share it.
struct PipelineTree {
  const NamedStep* step = nullptr;     ///< A step of the experiment; null at the root.
  std::vector<std::size_t> variants;   ///< Variants that end here, indices in Experiment::variants.
  std::vector<PipelineTree> branches;  ///< In the order of the variants.
};

/// The tree of `variants`, which are indices in Experiment::variants. Two steps are merged if they
/// and all their predecessors have the same names, types and parameters: they then draw the same
/// random numbers and compute the same bits. The experiment must outlive the tree.
PipelineTree pipeline_tree(const Experiment& experiment, const std::vector<std::size_t>& variants);

/// Runs `rig` along all paths of `tree` and calls `at_end(variant, rig)` for each variant. `key`
/// identifies the random streams of steps that see the whole rig.
template <class AtEnd>
void run_tree(const PipelineTree& tree, Rig rig, const StreamKey& key, const AtEnd& at_end) {
  if (tree.step != nullptr) advance(rig, *tree.step, key);
  for (const std::size_t variant : tree.variants) at_end(variant, rig);
  for (const PipelineTree& branch : tree.branches) run_tree(branch, rig, key, at_end);
}

/// How often a step runs if none fails; a start of a group of scenes counts once.
struct StepCount {
  std::string step;       ///< The name of the step.
  std::size_t alone = 0;  ///< Without sharing steps between variants.
  std::size_t runs = 0;   ///< With shared first steps.
};

/// How often `plan` runs each step, in the order in which the variants first name the steps.
std::vector<StepCount> count_steps(const Experiment& experiment, const Plan& plan);

}  // namespace croon::experiments
