#include "experiments/file/experiment_loader.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

json minimal() {
  return json::parse(R"({"name": "x", "dataset": {"type": "fake"},
                         "pipeline": [{"step": "drift"}]})");
}

Experiment load(const json& experiment) {
  const test::TempFolder folder;
  return load_experiment(folder.write("x.json", experiment.dump()), test::fake_catalogue());
}

/// Faults as "where: message", in the order in which they were found.
std::vector<std::string> faults_of(const json& experiment) {
  std::vector<std::string> lines;
  try {
    load(experiment);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      lines.push_back(Fault{"", fault.where, fault.message}.line());
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(ExperimentLoader, FillsInTheDefaults) {
  const Experiment experiment = load(minimal());
  EXPECT_EQ(experiment.name, "x");
  EXPECT_EQ(experiment.starts.around, StartCentre::truth);
  EXPECT_EQ(experiment.starts.rotation_deg, 45.0);
  EXPECT_EQ(experiment.seed, 1U);
  ASSERT_EQ(experiment.variants.size(), 1U);
  EXPECT_EQ(experiment.variants[0].name, "base");
  EXPECT_EQ(
      experiment.variants[0].resolved,
      R"([{"name":"drift","step":"drift","size_m":0.01,"search":{"type":"coarse","step_deg":5}}])");
}

TEST(ExperimentLoader, ReadsEveryKey) {
  json experiment = minimal();
  experiment["description"] = "why";
  experiment["starts"] = {
      {"around", "nominal"}, {"rotation_deg", 180}, {"translation_m", 2}, {"trials", 7}};
  experiment["seed"] = 9007199254740992;
  experiment["success"] = {{"rotation_deg", 1}, {"translation_m", 0.2}};
  const Experiment read = load(experiment);
  EXPECT_EQ(read.description, "why");
  EXPECT_EQ(read.starts.around, StartCentre::nominal);
  EXPECT_EQ(read.starts.rotation_deg, 180.0);
  EXPECT_EQ(read.starts.translation_m, 2.0);
  EXPECT_EQ(read.starts.trials, 7);
  EXPECT_EQ(read.seed, 9007199254740992U);
  EXPECT_EQ(read.success.rotation_deg, 1.0);
  EXPECT_EQ(read.success.translation_m, 0.2);
}

TEST(ExperimentLoader, ShowsAllFaultsAtTheirPlaces) {
  const json experiment = json::parse(R"({
    "name": "../x", "dataset": {"type": "fakes"}, "sede": 1,
    "starts": {"around": "turth", "rotation_deg": 181, "trials": 0},
    "success": {"rotation": 1},
    "pipeline": [{"step": "drift", "size_m": "far"}, {"step": "drift", "search": {"type": "coarse", "step_deg": 0}}]
  })");
  EXPECT_EQ(faults_of(experiment),
            (Lines{"/sede: unknown key \"sede\"; did you mean \"seed\"?",
                   "/name: expected a name for a folder: letters, digits, _ . and -, not starting "
                   "with a dot, found "
                   "\"../x\"",
                   "/dataset/type: expected a dataset, found \"fakes\"; did you mean \"fake\"?",
                   "/starts/around: expected one of truth, nominal, initial, found \"turth\"; did "
                   "you mean \"truth\"?",
                   "/starts/rotation_deg: expected a number from 0 to 180, found 181",
                   "/starts/trials: expected a whole number from 1 to 1000000, found 0",
                   "/success/rotation: unknown key \"rotation\"; did you mean \"rotation_deg\"?",
                   "/pipeline/1: two steps are called \"drift\": give one of them a \"name\"",
                   "/pipeline/0/size_m: expected a number, found \"far\"",
                   "/pipeline/1/search/step_deg: expected a number from 0.1 to 90, found 0"}));
}

TEST(ExperimentLoader, NamesWhatIsMissing) {
  EXPECT_EQ(faults_of(json::object()),
            (Lines{"/: the key \"name\" is missing", "/: the key \"dataset\" is missing",
                   "/: the key \"pipeline\" is missing"}));
  EXPECT_EQ(faults_of(json::array()), Lines{"/: expected an object, found []"});
}

TEST(ExperimentLoader, WantsAWholeSeed) {
  for (const json& seed : {json(-1), json(0.5), json("1"), json(9007199254740994), json(nullptr)}) {
    json experiment = minimal();
    experiment["seed"] = seed;
    EXPECT_EQ(
        faults_of(experiment),
        Lines{"/seed: expected a whole number from 0 to 9007199254740992, found " + seed.dump()});
  }
}

TEST(ExperimentLoader, WantsNamesThatAreFolders) {
  for (const char* name : {"", ".x", "a/b", "a b", "a,b", "..", "\n"}) {
    json experiment = minimal();
    experiment["name"] = name;
    EXPECT_EQ(faults_of(experiment).size(), 1U) << name;
  }
  json experiment = minimal();
  experiment["name"] = "A-z_0.9";
  EXPECT_EQ(faults_of(experiment), Lines{});
}

TEST(ExperimentLoader, WantsAPipelineOfNamedSteps) {
  json experiment = minimal();
  experiment["pipeline"] = json::array();
  EXPECT_EQ(faults_of(experiment),
            Lines{"/pipeline: expected a list of at least one step, found []"});
  experiment["pipeline"] =
      json::parse(R"([{"step": "drift"}, {"step": "drift", "name": "again"}])");
  EXPECT_EQ(faults_of(experiment), Lines{});
  experiment["pipeline"][1]["name"] = "a.b";
  EXPECT_EQ(faults_of(experiment),
            Lines{"/pipeline/1/name: expected a name of letters, digits, _ and -, found \"a.b\""});
  experiment["pipeline"][1] = 5;
  EXPECT_EQ(faults_of(experiment), Lines{"/pipeline/1: expected an object, found 5"});
}

TEST(ExperimentLoader, NamesTheFileOfAFault) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.write("twice.json", R"({"name": "x", "name": "y"})");
  try {
    load_experiment(path, test::fake_catalogue());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].line(),
              path.string() + ": /name: the key \"name\" stands here twice");
  }
  EXPECT_THROW(load_experiment(folder.path() / "none.json", test::fake_catalogue()), InputError);
}

}  // namespace
}  // namespace croon::experiments
