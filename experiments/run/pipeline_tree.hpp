#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The pipelines of variants, merged where they begin alike: each path from the root is the
/// pipeline of the variants that end there. A step of the tree runs once for each start, whatever
/// the number of variants behind it.
struct PipelineTree {
  const NamedStep* step = nullptr;     ///< Of the experiment; null at the root.
  std::vector<std::size_t> variants;   ///< Places in Experiment::variants of those that end here.
  std::vector<PipelineTree> branches;  ///< In the order of the variants.
};

/// The tree of `variants`, places in Experiment::variants. Two steps are one where they have the
/// same name, type and parameters, and so have all steps before them: then they draw the same
/// numbers and come to the same bits. The experiment must outlive the tree.
PipelineTree pipeline_tree(const Experiment& experiment, const std::vector<std::size_t>& variants);

/// Takes `result` along all paths of `tree` and calls `at_end(variant, result)` for each variant.
template <class AtEnd>
void run_tree(const PipelineTree& tree, PipelineResult result, const StreamKey& key,
              const AtEnd& at_end) {
  if (tree.step != nullptr) advance(result, *tree.step, key);
  for (const std::size_t variant : tree.variants) at_end(variant, result);
  for (const PipelineTree& branch : tree.branches) run_tree(branch, result, key, at_end);
}

}  // namespace croon::experiments
