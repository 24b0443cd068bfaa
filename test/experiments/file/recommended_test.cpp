// A stage's defaults are what the tree recommends: the paper's pipeline, as composed by
// experiments/paper/pipeline.json, is the one that names its steps and nothing else.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/file/experiment.hpp"
#include "registry/registry.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

TEST(Recommended, DefaultsOfStagesAreThoseOfThePapersPipeline) {
  const std::filesystem::path paper = test::source_root() / "experiments/paper/pipeline.json";
  json file = json::parse(std::ifstream(paper));
  for (json& step : file["pipeline"]) {
    // No crop is right for every sensor, so preprocessing has none unless the file lists some.
    if (step["step"] != "preprocessing") step = {{"step", step["step"]}};
  }
  const test::TempFolder folder;
  std::ofstream(folder.path() / "defaults.json") << file;
  const auto resolved = [](const std::filesystem::path& path) {
    return json(pipeline_json(load_experiment(path, registry()).variants.at(0).pipeline));
  };
  EXPECT_EQ(json::diff(resolved(paper), resolved(folder.path() / "defaults.json")), json::array());
}

}  // namespace
}  // namespace croon::experiments
