#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run/trial_plan.hpp"
#include "framework/pipeline/rig.hpp"

namespace croon::experiments {

/// The pipelines of variants, with their common beginnings merged: each path from the root is the
/// pipeline of the variants that end there. A step of the tree runs once per start, whatever the
/// number of variants that share it.
struct PipelineTree {
  const NamedStep* step = nullptr;     ///< Of the experiment; null at the root.
  std::vector<std::size_t> variants;   ///< Indices in Experiment::variants of those that end here.
  std::vector<PipelineTree> branches;  ///< In the order of the variants.
};

/// The tree of `variants`, indices in Experiment::variants. Two steps are
/// merged if they and all steps before them have the same names, types and parameters: then they
/// draw the same numbers and compute the same bits. The experiment must outlive the tree.
PipelineTree pipeline_tree(const Experiment& experiment, const std::vector<std::size_t>& variants);

/// Takes `rig` along all paths of `tree` and calls `at_end(variant, rig)` for each variant. `key`
/// names the random streams of steps that see the whole rig.
template <class AtEnd>
void run_tree(const PipelineTree& tree, Rig rig, const StreamKey& key, const AtEnd& at_end) {
  if (tree.step != nullptr) advance(rig, *tree.step, key);
  for (const std::size_t variant : tree.variants) at_end(variant, rig);
  for (const PipelineTree& branch : tree.branches) run_tree(branch, rig, key, at_end);
}

/// How often a step runs, if none fails; a start of a group of scenes counts once.
struct StepCount {
  std::string step;       ///< Its name.
  std::size_t alone = 0;  ///< If each variant runs by itself.
  std::size_t runs = 0;   ///< If variants share their first steps.
};

/// How often `plan` runs each step, in the order in which the variants first name them.
std::vector<StepCount> count_steps(const Experiment& experiment, const Plan& plan);

}  // namespace croon::experiments
