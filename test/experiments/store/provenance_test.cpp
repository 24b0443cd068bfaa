#include "experiments/store/manifest.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/file/experiment.hpp"
#include "experiments/store/store_header.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

TEST(Provenance, CloudsThatAreInNoFileAreNoInputs) {
  const test::TempFolder folder;
  const auto path = folder.write(
      "x.json",
      R"({"name": "x", "dataset": {"type": "fake"}, "starts": {}, "pipeline": [{"step": "drift"}]})");
  const Experiment experiment = load_experiment(path, test::fake_catalogue());
  std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  const std::vector<InputFile> inputs = record_inputs(scenes, "/no/such/folder", 2);
  EXPECT_TRUE(inputs.empty());
  const Provenance provenance = provenance_of(experiment, scenes, inputs);
  const auto manifest =
      nlohmann::json::parse(manifest_json(experiment, scenes, inputs, provenance));
  EXPECT_EQ(manifest["inputs"], nlohmann::json::array());
}

TEST(StoreHeader, WhatIsCurrentInOneFolderIsCurrentInTheMerge) {
  StoreHeader left, right;
  left.variants = {{"base", "", true}, {"far", "", false}, {"near", "", true}};
  right.variants = {{"base", "", true}, {"far", "", true}};
  for (const StoreHeader& merged : {united(left, right), united(right, left)}) {
    ASSERT_EQ(merged.variants.size(), 3U);
    for (const StoredName& variant : merged.variants) EXPECT_TRUE(variant.is_current);
  }
}

}  // namespace
}  // namespace croon::experiments
