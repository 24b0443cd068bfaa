// The JSON Schema and the loader say the same of experiment files. The schema is read by
// python3-jsonschema, where that is installed.
#include "registry/schema.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "experiments/file/experiment_loader.hpp"
#include "framework/base/error.hpp"
#include "registry/registry.hpp"
#include "test/house/script.hpp"
#include "test/house/tree.hpp"
#include "test/support/nested_stage.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class SchemaAndLoader : public testing::Test {
 protected:
  void SetUp() override {
    if (run_script("python3 -c 'import jsonschema'", folder_.path()).status != 0) {
      GTEST_SKIP() << "python3-jsonschema is not installed";
    }
    catalogue_.add(nested_stage());
    std::ofstream(folder_.path() / "schema.json") << experiment_schema(catalogue_);
  }

  /// Those of `files` that the schema takes.
  std::set<std::string> taken_by_schema(const std::vector<fs::path>& files) const {
    std::string command = "python3 '" + (source_root() / "test/house/check_schema.py").string() +
                          "' schema.json 2> faults.txt";
    for (const fs::path& file : files) command += " '" + file.string() + "'";
    const Finished finished = run_script(command, folder_.path());
    EXPECT_EQ(finished.status, 0) << finished.output;
    std::set<std::string> taken;
    std::istringstream lines(finished.output);
    for (std::string line; std::getline(lines, line);) taken.insert(line);
    return taken;
  }

  bool is_loaded(const fs::path& file) const {
    try {
      experiments::load_experiment(file, catalogue_);
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  /// Expects that both take each experiment where it `is_valid`, and that neither does where not.
  void expect_verdicts(const std::vector<std::pair<json, bool>>& cases) const {
    std::vector<fs::path> files;
    for (const auto& [experiment, is_valid] : cases) {
      files.push_back(folder_.path() / (std::to_string(files.size()) + ".json"));
      std::ofstream(files.back()) << experiment;
    }
    const std::set<std::string> taken = taken_by_schema(files);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      EXPECT_EQ(taken.count(files[i].string()) == 1, cases[i].second)
          << "schema: " << cases[i].first;
      EXPECT_EQ(is_loaded(files[i]), cases[i].second) << "loader: " << cases[i].first;
    }
  }

 private:
  TempFolder folder_;
  /// The stages of the build, and one with objects in it.
  Catalogue catalogue_ = registry();
};

json experiment() {
  return json::parse(R"({
    "name": "agreement",
    "dataset": {"type": "opencalib", "path": "somewhere"},
    "pipeline": [{"step": "ground_alignment"}, {"step": "yaw_alignment", "name": "yaw"}],
    "variants": [{"name": "no ground", "remove": ["ground_alignment"]},
                 {"name": "other", "replace": {"yaw.search": {"type": "exhaustive"},
                                               "ground_alignment": {"step": "identity"}}}],
    "grid": {"yaw.max_points": [100, 200]}})");
}

TEST_F(SchemaAndLoader, TakeTheCommittedExperiments) {
  if (registry().find("ground_extractor", "cgal_region_growing") == nullptr) {
    GTEST_SKIP() << "experiments of the tree compare stages that need CGAL";
  }
  std::vector<fs::path> files;
  for (const std::string& file : tree_files("experiments/", ".json")) {
    files.push_back(source_root() / file);
    EXPECT_TRUE(is_loaded(files.back())) << file;
  }
  EXPECT_FALSE(files.empty());
  EXPECT_EQ(taken_by_schema(files).size(), files.size());
}

TEST_F(SchemaAndLoader, AgreeOnWhatIsWrong) {
  const std::vector<std::pair<const char*, json>> wrong = {
      {"/surprise", 1},
      {"/name", ""},
      {"/name", ".hidden"},
      {"/seed", -1},
      {"/dataset/type", "none"},
      {"/pipeline", json::array()},
      {"/pipeline/0/step", "none"},
      {"/pipeline/1/search", {{"type", "none"}}},
      {"/pipeline/1/max_distance_m", -1},
      {"/pipeline/1/name", "with.dot"},
      {"/starts", {{"around", "nowhere"}}},
      {"/success", {{"rotation", 1}}},
      {"/variants/0/name", ".dot"},
      {"/variants/0/more", 1},
      {"/variants/1/replace/yaw.none", 1},
      {"/grid/yaw.max_points", json::array()},
      {"/grid/yaw.max_points", 100}};
  std::vector<std::pair<json, bool>> cases = {{experiment(), true}};
  for (const auto& [pointer, value] : wrong) {
    json changed = experiment();
    changed[json::json_pointer(pointer)] = value;
    cases.emplace_back(changed, false);
  }
  for (const char* key : {"name", "dataset", "pipeline"}) {
    json changed = experiment();
    changed.erase(key);
    cases.emplace_back(changed, false);
  }
  expect_verdicts(cases);
}

TEST_F(SchemaAndLoader, AgreeOnObjectsInAStage) {
  const std::vector<std::tuple<const char*, json, bool>> datasets = {
      {"/rig", "pair", true},
      {"/rig", "pear", false},
      {"/rig", json::object(), false},
      {"/rig", {{"reference", "a"}}, false},
      {"/rig", {{"like", "pair"}, {"reference", "a"}}, true},
      {"/rig", {{"like", "pear"}}, false},
      {"/rig", {{"reference", "a"}, {"sensors", json::object()}}, false},
      {"/rig", {{"reference", "a"}, {"sensors", {{"b", json::object()}}}}, true},
      {"/rig", {{"reference", "a"}, {"sensors", {{"b c", json::object()}}}}, false},
      {"/rig", {{"reference", "a"}, {"sensors", {{"b", {{"model", "fine"}}}}}}, true},
      {"/rig", {{"reference", "a"}, {"sensors", {{"b", {{"model", 1}}}}}}, false},
      {"/rig/sensors/b/model/rings", 128, true},
      {"/rig/sensors/b/model/rings", 129, false},
      {"/rig/sensors/b/model/like", "coarse", true},
      {"/rig/sensors/b/none", 1, false},
      {"/mix", "word", false},
      {"/mix", {{"like", "word"}}, false},
      {"/mix", {{"urban", 1}}, true},
      {"/model", nullptr, false}};
  std::vector<std::pair<json, bool>> cases;
  for (const auto& [pointer, value, is_valid] : datasets) {
    json changed = experiment();
    changed["dataset"] = {{"type", "nested"}, {"rig", {{"like", "pair"}}}};
    changed["dataset"][json::json_pointer(pointer)] = value;
    cases.emplace_back(changed, is_valid);
  }
  expect_verdicts(cases);
}

TEST_F(SchemaAndLoader, AgreeOnTheEndsOfRanges) {
  const json schema = json::parse(experiment_schema(registry()));
  std::vector<std::pair<json, bool>> cases;
  for (const char* object : {"starts", "success"}) {
    for (const auto& [key, value] : schema["properties"][object]["properties"].items()) {
      if (!value.contains("minimum")) continue;
      const double minimum = value["minimum"].get<double>();
      const double maximum = value["maximum"].get<double>();
      for (const double number : {minimum - 1.0, minimum, maximum, maximum + 1.0}) {
        json changed = experiment();
        changed[object][key] = number;
        cases.emplace_back(changed, number >= minimum && number <= maximum);
      }
    }
  }
  EXPECT_FALSE(cases.empty());
  expect_verdicts(cases);
}

TEST_F(SchemaAndLoader, AgreeOnDefaults) {
  const json properties = json::parse(experiment_schema(registry()))["properties"];
  const json& starts = properties["starts"]["properties"];
  const experiments::StartRule rule;
  EXPECT_EQ(starts["around"]["default"], experiments::centre_name(rule.around));
  EXPECT_EQ(starts["rotation_deg"]["default"].get<double>(), rule.rotation_deg);
  EXPECT_EQ(starts["translation_m"]["default"].get<double>(), rule.translation_m);
  EXPECT_EQ(starts["trials"]["default"].get<int>(), rule.trials);
  const json& success = properties["success"]["properties"];
  const SuccessBounds bounds;
  EXPECT_EQ(success["rotation_deg"]["default"].get<double>(), bounds.rotation_deg);
  EXPECT_EQ(success["translation_m"]["default"].get<double>(), bounds.translation_m);
  EXPECT_EQ(properties["seed"]["default"].get<std::uint64_t>(), experiments::Experiment{}.seed);
}

}  // namespace
}  // namespace croon::test
