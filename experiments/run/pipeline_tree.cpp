#include "experiments/run/pipeline_tree.hpp"

#include <algorithm>

namespace croon::experiments {
namespace {

bool is_same(const NamedStep& a, const NamedStep& b) {
  return a.name == b.name && a.step.resolved() == b.step.resolved();
}

/// The branch of `tree` that begins with `step`; added if missing.
PipelineTree& branch_of(PipelineTree& tree, const NamedStep& step) {
  const auto found =
      std::find_if(tree.branches.begin(), tree.branches.end(),
                   [&](const PipelineTree& branch) { return is_same(*branch.step, step); });
  if (found != tree.branches.end()) return *found;
  tree.branches.push_back({&step, {}, {}});
  return tree.branches.back();
}

StepCount& count_of(std::vector<StepCount>& counts, const std::string& step) {
  const auto found = std::find_if(counts.begin(), counts.end(),
                                  [&](const StepCount& count) { return count.step == step; });
  if (found != counts.end()) return *found;
  counts.push_back({step});
  return counts.back();
}

void add_runs(std::vector<StepCount>& counts, const PipelineTree& tree, std::size_t starts) {
  if (tree.step != nullptr) count_of(counts, tree.step->name).runs += starts;
  for (const PipelineTree& branch : tree.branches) add_runs(counts, branch, starts);
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

std::vector<StepCount> count_steps(const Experiment& experiment, const Plan& plan) {
  std::vector<std::size_t> starts(plan.variants.size(), 0);
  for (const PlannedStart& start : plan.starts) ++starts[start.variants];
  std::vector<StepCount> counts;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    for (const std::size_t variant : plan.variants[i]) {
      for (const NamedStep& step : experiment.variants[variant].pipeline) {
        count_of(counts, step.name).alone += starts[i];
      }
    }
    add_runs(counts, pipeline_tree(experiment, plan.variants[i]), starts[i]);
  }
  return counts;
}

}  // namespace croon::experiments
