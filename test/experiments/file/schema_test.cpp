// The JSON Schema and the loader say the same of experiment files. The schema is read by
// python3-jsonschema, where that is installed.
#include "experiments/file/experiment.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "registry/registry.hpp"
#include "test/support/nested_stage.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Finished;
using test::nested_stage;
using test::run_script;
using test::source_root;
using test::TempFolder;
using test::tree_files;

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
    std::string command = "python3 '" +
                          (source_root() / "test/experiments/file/check_schema.py").string() +
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
      load_experiment(file, catalogue_);
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
    const fs::path path = source_root() / file;
    EXPECT_NO_THROW(validate_experiment(path, registry())) << file;
    // The schema is that of experiments that can be run, not of workloads.
    if (is_loaded(path)) files.push_back(path);
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
    const json& of = schema["properties"][object];
    const json& keys = (of.contains("anyOf") ? of["anyOf"][1] : of)["properties"];
    for (const auto& [key, value] : keys.items()) {
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

/// Every `$ref` leads somewhere.
void expect_references(const json& part, const json& whole) {
  if (part.is_object() && part.contains("$ref")) {
    const std::string reference = part["$ref"].get<std::string>();
    EXPECT_TRUE(whole.contains(json::json_pointer(reference.substr(1)))) << reference;
  }
  if (!part.is_structured()) return;
  for (const json& below : part) expect_references(below, whole);
}

TEST(Schema, ReferencesLeadSomewhere) {
  const json schema = json::parse(experiment_schema(registry()));
  expect_references(schema, schema);
}

TEST_F(SchemaAndLoader, AgreeOnKeysThatBelongTogether) {
  const json claim = json::parse(
      R"({"claim": "c", "source": "s", "measure": "yaw", "statistic": "std", "value": 1,
          "band": [0, 1]})");
  const json table = json::parse(
      R"({"claim": "c", "source": "s", "measures": ["yaw"], "band_rule": {"rule": "no_worse"},
          "values": {"left": {"std": [1]}}})");
  const auto with = [](json object, const char* key, const json& value) {
    object[key] = value;
    if (value.is_null()) object.erase(key);
    return object;
  };
  const json step = {{"step", "identity"}};
  const std::vector<std::tuple<const char*, json, bool>> changes = {
      {"/starts", json::parse(R"({"sweep": {"rotation_deg": [0, 90]}})"), true},
      {"/starts", json::parse(R"({"sweep": {"rotation_deg": [0, 90], "levels": 1}})"), false},
      {"/starts", json::parse(R"({"sweep": {}})"), false},
      {"/starts", json::parse(R"({"sweep": {"rotation_deg": [0, 90]}, "rotation_deg": 1})"), false},
      {"/starts", json::parse(R"({"sweep": {"rotation_deg": [0, 90]}, "translation_m": 1})"), true},
      {"/starts", json::parse(R"({"sweep": {"rotation_deg": [0, 9], "translation_m": [0, 1]}})"),
       false},
      {"/starts", {{"file", "a.csv"}, {"trials", 3}, {"sha256", "12"}}, true},
      {"/starts", {{"file", "a.csv"}, {"around", "truth"}}, false},
      {"/starts", {{"sha256", "12"}}, false},
      {"/starts", "none", true},
      {"/starts", "some", false},
      {"/claims", json::array({claim, table}), true},
      {"/claims/0", with(claim, "measure", nullptr), false},
      {"/claims/0", with(claim, "why", ""), false},
      {"/claims/0", with(claim, "sensor", ""), false},
      {"/starts", {{"file", ""}}, false},
      {"/description", "", true},
      {"/claims/0", with(claim, "statistic", "success"), false},
      {"/claims/0", with(with(claim, "statistic", "success"), "measure", nullptr), true},
      {"/claims/0", with(claim, "band", {0, 1, 2}), false},
      {"/claims/0", with(claim, "value", nullptr), false},
      {"/claims/0", with(claim, "values", table["values"]), false},
      {"/claims/0", with(table, "measures", nullptr), false},
      {"/claims/0", with(table, "band", {0, 1}), false},
      {"/claims/0", with(table, "band_rule", {{"rule", "around_zero"}}), false},
      {"/claims/0",
       with(table, "band_rule", {{"rule", "around_zero"}, {"half_width", json::array({1})}}), true},
      {"/variants/0/insert", json::array({{{"after", "yaw"}, {"step", step}}}), true},
      {"/variants/0/insert", json::array({{{"step", step}}}), false},
      {"/variants/0/insert", json::array({{{"after", "yaw"}, {"before", "yaw"}, {"step", step}}}),
       false},
      {"/variants/0/insert", json::array({{{"after", "yaw"}}}), false},
      {"/variants/0/pipeline", json::array({{{"step", "ground_alignment"}}}), true},
      {"/variants/0/pipeline", json::array(), false}};
  std::vector<std::pair<json, bool>> cases;
  for (const auto& [pointer, value, is_valid] : changes) {
    json changed = experiment();
    const bool is_claim = std::string(pointer) == "/claims/0";
    if (is_claim) changed["claims"] = json::array();
    changed[json::json_pointer(pointer)] = value;
    cases.emplace_back(changed, is_valid);
  }
  expect_verdicts(cases);
}

TEST(Schema, IsThatOfThePage) {
  // Stages from outside the tree are not on the page.
  Catalogue catalogue;
  for (const StageEntry& entry : registry().entries()) {
    const std::string file = "stages/" + entry.kind + "/" + entry.name + ".cpp";
    if (std::filesystem::exists(test::source_root() / file)) catalogue.add(entry);
  }
  if (catalogue.entries().size() != test::tree_files("stages/", ".cpp").size()) {
    GTEST_SKIP() << "this build leaves out stages of the tree";
  }
  EXPECT_EQ(read_whole_file(test::source_root() / "docs/schema/experiment.schema.json"),
            experiment_schema(catalogue))
      << "run make docs";
}

TEST_F(SchemaAndLoader, AgreeOnDefaults) {
  const json properties = json::parse(experiment_schema(registry()))["properties"];
  const json& starts = properties["starts"]["anyOf"][1]["properties"];
  const StartRule rule;
  EXPECT_EQ(starts["around"]["default"], params::word_of(kStartCentres, rule.around));
  EXPECT_EQ(starts["rotation_deg"]["default"].get<double>(), rule.rotation_deg);
  EXPECT_EQ(starts["translation_m"]["default"].get<double>(), rule.translation_m);
  EXPECT_EQ(starts["trials"]["default"].get<int>(), rule.trials);
  const json& success = properties["success"]["properties"];
  const SuccessBounds bounds;
  EXPECT_EQ(success["rotation_deg"]["default"].get<double>(), bounds.rotation_deg);
  EXPECT_EQ(success["translation_m"]["default"].get<double>(), bounds.translation_m);
  EXPECT_EQ(properties["seed"]["default"].get<std::uint64_t>(), Experiment{}.seed);
}

}  // namespace
}  // namespace croon::experiments
