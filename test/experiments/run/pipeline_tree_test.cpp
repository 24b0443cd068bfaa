#include "experiments/run/pipeline_tree.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "experiments/file/experiment.hpp"
#include "framework/base/rng.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

Experiment load_tree(const json& experiment) {
  const test::TempFolder folder;
  return load_experiment(folder.write("x.json", experiment.dump()), test::fake_catalogue());
}

/// Three steps; `variants` as in the file.
Experiment with_variants(const char* variants) {
  json experiment = json::parse(R"({"name": "x", "dataset": {"type": "fake"}, "pipeline": [
      {"step": "drift", "name": "first"}, {"step": "drift", "name": "second"}, {"step": "behave"}]})");
  experiment["variants"] = json::parse(variants);
  return load_tree(experiment);
}

std::vector<std::size_t> all_variants(const Experiment& experiment) {
  std::vector<std::size_t> variants(experiment.variants.size());
  std::iota(variants.begin(), variants.end(), std::size_t{0});
  return variants;
}

std::size_t steps_of(const PipelineTree& tree) {
  std::size_t count = tree.step == nullptr ? 0 : 1;
  for (const PipelineTree& branch : tree.branches) count += steps_of(branch);
  return count;
}

/// The names and parameters of the steps on the way to each variant.
void collect_paths(const PipelineTree& tree, std::vector<std::string> path,
                   std::map<std::size_t, std::vector<std::string>>& paths) {
  if (tree.step != nullptr) path.push_back(tree.step->name + tree.step->step.resolved());
  for (const std::size_t variant : tree.variants) EXPECT_TRUE(paths.emplace(variant, path).second);
  for (const PipelineTree& branch : tree.branches) collect_paths(branch, path, paths);
}

/// Every variant is in `tree` once, behind the steps of its pipeline.
void expect_pipelines(const Experiment& experiment, const PipelineTree& tree) {
  std::map<std::size_t, std::vector<std::string>> paths;
  collect_paths(tree, {}, paths);
  ASSERT_EQ(paths.size(), experiment.variants.size());
  for (const auto& [variant, path] : paths) {
    std::vector<std::string> pipeline;
    for (const NamedStep& step : experiment.variants[variant].pipeline) {
      pipeline.push_back(step.name + step.step.resolved());
    }
    EXPECT_EQ(path, pipeline) << experiment.variants[variant].name;
  }
}

TEST(PipelineTree, SharesWhatVariantsBeginWith) {
  const Experiment experiment = with_variants(R"([
      {"name": "other end", "replace": {"behave.how": "reject"}},
      {"name": "other middle", "replace": {"second.size_m": 3}},
      {"name": "other beginning", "replace": {"first.size_m": 3}},
      {"name": "shorter", "remove": ["behave"]},
      {"name": "twin", "replace": {"behave.how": "pass"}}])");
  const PipelineTree tree = pipeline_tree(experiment, all_variants(experiment));
  expect_pipelines(experiment, tree);
  // first, second, behave; behave; second, behave; first, second, behave; the last two have none.
  EXPECT_EQ(steps_of(tree), 3U + 1U + 2U + 3U);
}

TEST(PipelineTree, SharesNoStepBehindOneThatDiffers) {
  const Experiment experiment =
      with_variants(R"([{"name": "other", "replace": {"first.size_m": 3}}])");
  EXPECT_EQ(steps_of(pipeline_tree(experiment, {0, 1})), 6U);
}

TEST(PipelineTree, TellsStepsOfOneKindByTheirNames) {
  // Their streams of random numbers bear their names.
  const Experiment experiment = with_variants(R"([{"name": "second alone", "remove": ["first"]}])");
  EXPECT_EQ(steps_of(pipeline_tree(experiment, {0, 1})), 5U);
}

TEST(PipelineTree, OfSomeVariantsHasThese) {
  const Experiment experiment = with_variants(R"([
      {"name": "a", "replace": {"behave.how": "reject"}},
      {"name": "b", "replace": {"first.size_m": 3}}])");
  EXPECT_EQ(steps_of(pipeline_tree(experiment, {2})), 3U);
  EXPECT_EQ(steps_of(pipeline_tree(experiment, {0, 1})), 4U);
  EXPECT_TRUE(pipeline_tree(experiment, {}).branches.empty());
}

/// A grid of random lists on random places, with repeats.
Experiment random_grid(Rng& rng) {
  json experiment = json::parse(R"({"name": "x", "dataset": {"type": "fake"}, "pipeline": [
      {"step": "drift", "name": "a"}, {"step": "drift", "name": "b"},
      {"step": "drift", "name": "c"}]})");
  for (const char* step : {"a", "b", "c"}) {
    json sizes = json::array();
    const int count = 1 + static_cast<int>(rng.uniform() * 3.0);
    for (int i = 0; i < count; ++i) sizes.push_back(i + 1);
    experiment["grid"][std::string(step) + ".size_m"] = sizes;
  }
  return load_tree(experiment);
}

TEST(PipelineTree, OfAnyGridHasEachPrefixOnce) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    const Experiment experiment = random_grid(rng);
    const PipelineTree tree = pipeline_tree(experiment, all_variants(experiment));
    expect_pipelines(experiment, tree);
    std::map<std::string, int> prefixes;
    for (const Variant& variant : experiment.variants) {
      std::string prefix;
      for (const NamedStep& step : variant.pipeline) {
        prefix += step.name + step.step.resolved() + "\n";
        ++prefixes[prefix];
      }
    }
    EXPECT_EQ(steps_of(tree), prefixes.size());
  }
}

TEST(StepCounts, AreThoseOfTheTree) {
  const Experiment experiment = with_variants(R"([
      {"name": "other end", "replace": {"behave.how": "reject"}},
      {"name": "other middle", "replace": {"second.size_m": 3}}])");
  const std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  const Plan plan = plan_trials(experiment, scenes, {all_variants(experiment), {}});
  const std::size_t starts = plan.starts.size();
  EXPECT_EQ(plan.trials, 3 * starts);
  const std::vector<StepCount> counts = count_steps(experiment, plan);
  ASSERT_EQ(counts.size(), 3U);
  const std::size_t runs[] = {1, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(counts[i].alone, 3 * starts);
    EXPECT_EQ(counts[i].runs, runs[i] * starts);
  }
  EXPECT_EQ(counts[0].step, "first");
}

}  // namespace
}  // namespace croon::experiments
