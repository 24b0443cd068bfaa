#include "experiments/run/pipeline_tree.hpp"

#include <algorithm>

namespace croon::experiments {
namespace {

bool is_same(const NamedStep& a, const NamedStep& b) {
  return a.name == b.name && a.step.resolved() == b.step.resolved();
}

/// The branch of `tree` that begins with `step`, grown where there is none.
PipelineTree& branch_of(PipelineTree& tree, const NamedStep& step) {
  const auto found =
      std::find_if(tree.branches.begin(), tree.branches.end(),
                   [&](const PipelineTree& branch) { return is_same(*branch.step, step); });
  if (found != tree.branches.end()) return *found;
  tree.branches.push_back({&step, {}, {}});
  return tree.branches.back();
}

}  // namespace

PipelineTree pipeline_tree(const Experiment& experiment, const std::vector<std::size_t>& variants) {
  PipelineTree root;
  for (const std::size_t variant : variants) {
    PipelineTree* end = &root;
    for (const NamedStep& step : experiment.variants[variant].pipeline) {
      end = &branch_of(*end, step);
    }
    end->variants.push_back(variant);
  }
  return root;
}

}  // namespace croon::experiments
