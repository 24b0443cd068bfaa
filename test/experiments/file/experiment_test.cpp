#include "experiments/file/experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/io/digest.hpp"
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

TEST(Experiment, FillsInTheDefaults) {
  const Experiment experiment = load(minimal());
  EXPECT_EQ(experiment.name, "x");
  EXPECT_EQ(experiment.starts.around, StartCentre::truth);
  EXPECT_EQ(experiment.starts.rotation_deg, 45.0);
  EXPECT_EQ(experiment.seed, 1U);
  ASSERT_EQ(experiment.variants.size(), 1U);
  EXPECT_EQ(experiment.variants[0].name, "base");
  EXPECT_EQ(
      pipeline_json(experiment.variants[0].pipeline).dump(),
      R"([{"name":"drift","step":"drift","size_m":0.01,"search":{"type":"coarse","step_deg":5}}])");
}

TEST(Experiment, ReadsEveryKey) {
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

TEST(Experiment, ShowsAllFaultsAtTheirPlaces) {
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

TEST(Experiment, NamesWhatIsMissing) {
  EXPECT_EQ(faults_of(json::object()),
            (Lines{"/: the key \"name\" is missing", "/: the key \"dataset\" is missing",
                   "/: the key \"pipeline\" is missing"}));
  EXPECT_EQ(faults_of(json::array()), Lines{"/: expected an object, found []"});
}

TEST(Experiment, WantsAWholeSeed) {
  for (const json& seed : {json(-1), json(0.5), json("1"), json(9007199254740994), json(nullptr)}) {
    json experiment = minimal();
    experiment["seed"] = seed;
    EXPECT_EQ(
        faults_of(experiment),
        Lines{"/seed: expected a whole number from 0 to 9007199254740992, found " + seed.dump()});
  }
}

TEST(Experiment, WantsNamesThatAreFolders) {
  for (const char* name : {"", ".x", "a/b", "a b", "a,b", "..", "\n"}) {
    json experiment = minimal();
    experiment["name"] = name;
    EXPECT_EQ(faults_of(experiment).size(), 1U) << name;
  }
  json experiment = minimal();
  experiment["name"] = "A-z_0.9";
  EXPECT_EQ(faults_of(experiment), Lines{});
}

TEST(Experiment, WantsAPipelineOfNamedSteps) {
  json experiment = minimal();
  experiment["pipeline"] = json::array();
  EXPECT_EQ(faults_of(experiment),
            Lines{"/pipeline: expected a list of at least one step, found []"});
  experiment["pipeline"] =
      json::parse(R"([{"step": "drift"}, {"step": "drift", "name": "again"}])");
  EXPECT_EQ(faults_of(experiment), Lines{});
  experiment["pipeline"][1]["name"] = "a.b";
  EXPECT_EQ(
      faults_of(experiment),
      Lines{"/pipeline/1/name: expected a name of letters, digits, _ and -, not starting with "
            "-, found \"a.b\""});
  experiment["pipeline"][1]["name"] = std::string(1001, 'n');
  EXPECT_EQ(faults_of(experiment),
            Lines{"/pipeline/1/name: expected a name of at most 1000 bytes, found one of 1001"});
  experiment["pipeline"][1] = 5;
  EXPECT_EQ(faults_of(experiment), Lines{"/pipeline/1: expected an object, found 5"});
}

TEST(Experiment, NamesTheFileOfAFault) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.write("twice.json", R"({"name": "x", "name": "y"})");
  try {
    load_experiment(path, test::fake_catalogue());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].line(), path.string() + ": /name: duplicate key \"name\"");
  }
  EXPECT_THROW(load_experiment(folder.path() / "none.json", test::fake_catalogue()), InputError);
}

/// A folder of experiments that extend each other.
class Extends : public testing::Test {
 protected:
  Experiment load(const std::string& file) const {
    return load_experiment(folder_.path() / file, test::fake_catalogue());
  }
  /// The faults of loading `file`, a line each, with paths below the folder.
  Lines faults_of(const std::string& file) const {
    Lines lines;
    try {
      load(file);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) {
        lines.push_back(Fault{std::filesystem::relative(fault.file, folder_.path()).string(),
                              fault.where, fault.message}
                            .line());
      }
    }
    return lines;
  }
  const test::TempFolder folder_;
};

TEST_F(Extends, TakesTheKeysOfTheOtherFileAsDefaults) {
  folder_.write("base.json", R"({"name": "base", "dataset": {"type": "fake"}, "seed": 7,
                                 "starts": {"trials": 3, "rotation_deg": 5},
                                 "pipeline": [{"step": "drift", "size_m": 2}]})");
  folder_.write("sub/x.json",
                R"({"extends": "../base.json", "name": "x", "starts": {"trials": 4}})");
  const Experiment experiment = load("sub/x.json");
  EXPECT_EQ(experiment.name, "x");
  EXPECT_EQ(experiment.seed, 7U);
  // A key replaces the whole key.
  EXPECT_EQ(experiment.starts.trials, 4);
  EXPECT_EQ(experiment.starts.rotation_deg, 45.0);
  EXPECT_EQ(pipeline_json(experiment.variants[0].pipeline)[0]["size_m"], 2);
  ASSERT_EQ(experiment.files.size(), 2U);
  EXPECT_EQ(experiment.files[0].path, "x.json");
  EXPECT_EQ(experiment.files[1].path, "../base.json");
  EXPECT_EQ(experiment.files[1].sha256, sha256_of_file(folder_.path() / "base.json"));
}

TEST_F(Extends, IsTheSameAsOneFileWithAllKeys) {
  folder_.write("a.json", R"({"dataset": {"type": "fake"}, "pipeline": [{"step": "drift"}]})");
  folder_.write("b.json", R"({"extends": "a.json", "seed": 5, "variants": [{"name": "v"}]})");
  folder_.write("c.json", R"({"extends": "b.json", "name": "n"})");
  folder_.write("whole.json", R"({"name": "n", "dataset": {"type": "fake"}, "seed": 5,
                                  "pipeline": [{"step": "drift"}], "variants": [{"name": "v"}]})");
  EXPECT_EQ(experiment_json(load("c.json")), experiment_json(load("whole.json")));
  EXPECT_EQ(*load("c.json").merged, *load("whole.json").merged);
}

TEST_F(Extends, OfAListTheLaterFileReplacesKeysOfTheEarlier) {
  folder_.write("study.json", R"({"name": "study", "dataset": {"type": "fake"}, "seed": 2,
                                  "pipeline": [{"step": "drift", "size_m": 2}]})");
  folder_.write("far.json", R"({"name": "far", "starts": {"trials": 3}, "seed": 5})");
  folder_.write("both.json", R"({"extends": ["study.json", "far.json"]})");
  const Experiment both = load("both.json");
  EXPECT_EQ(both.name, "study_far");
  EXPECT_EQ(both.seed, 5U);
  EXPECT_EQ(both.starts.trials, 3);
  ASSERT_EQ(both.files.size(), 3U);
  EXPECT_EQ(both.files[1].path, "study.json");
  EXPECT_EQ(both.files[2].path, "far.json");
  folder_.write("named.json", R"({"extends": ["study.json", "far.json"], "name": "mine"})");
  EXPECT_EQ(load("named.json").name, "mine");
  folder_.write("none.json", R"({"extends": ["study.json", "fra.json", 3, ""]})");
  EXPECT_EQ(faults_of("none.json"),
            (Lines{"none.json: /extends/2: expected a string, found 3",
                   "none.json: /extends/3: expected the path of an experiment file, found \"\""}));
}

TEST_F(Extends, AWorkloadReplacesKeysOfAnExperiment) {
  folder_.write("study.json", R"({"name": "study", "dataset": {"type": "fake"}, "seed": 2,
                                  "pipeline": [{"step": "drift", "size_m": 2}]})");
  folder_.write("far.json", R"({"name": "far", "dataset": {"type": "fake"}, "seed": 5})");
  const std::filesystem::path far = folder_.path() / "far.json";
  const Experiment both =
      load_experiment(folder_.path() / "study.json", test::fake_catalogue(), {far});
  EXPECT_EQ(both.name, "study_far");
  EXPECT_EQ(both.seed, 5U);
  folder_.write("both.json", R"({"extends": ["study.json", "far.json"]})");
  EXPECT_EQ(experiment_json(both), experiment_json(load("both.json")));
  // A workload is valid without a pipeline, but cannot be run alone.
  EXPECT_NO_THROW(validate_experiment(far, test::fake_catalogue()));
  EXPECT_EQ(faults_of("far.json").size(), 1U);
  folder_.write("far.json", R"({"name": "far", "dataset": {"type": "fakes"}})");
  EXPECT_THROW(validate_experiment(far, test::fake_catalogue()), InputError);
}

TEST_F(Extends, AWorkloadAndItsExperimentAreObjects) {
  const auto list = folder_.write("list.json", "[]");
  const auto whole = folder_.write("whole.json", minimal().dump());
  for (const auto& [experiment, workload] : {std::pair(whole, list), {list, whole}}) {
    EXPECT_EQ(test::input_error([&, path = experiment, with = workload] {
                load_experiment(path, test::fake_catalogue(), {with});
              }),
              list.string() + ": /: expected an object");
  }
}

TEST_F(Extends, APathDoesNotEndAtANullCharacter) {
  folder_.write("b.json", minimal().dump());
  folder_.write("a.json", R"({"extends": "b.json\u0000"})");
  EXPECT_EQ(faults_of("a.json").size(), 1U);
}

TEST_F(Extends, NamesTheFileOfEachFault) {
  folder_.write("base.json", R"({"dataset": {"type": "fakes"}, "sede": 1, "seed": -1,
                                 "pipeline": [{"step": "drift", "size_m": "far"}],
                                 "grid": {"drift.size_m": []}})");
  folder_.write("x.json", R"({"extends": "base.json", "name": "x", "seed": 1,
                              "variants": [{"name": "v", "replace": {"drift.size_m": "near"}}]})");
  EXPECT_EQ(faults_of("x.json"),
            (Lines{"base.json: /sede: unknown key \"sede\"; did you mean \"seed\"?",
                   "base.json: /dataset/type: expected a dataset, found \"fakes\"; did you mean "
                   "\"fake\"?",
                   "base.json: /grid/drift.size_m: expected a list of at least one value, found []",
                   "base.json: /pipeline/0/size_m: expected a number, found \"far\"",
                   "x.json: /variants/0/replace/drift.size_m: expected a number, found \"near\""}));
}

TEST(Experiment, HasANameThatAFolderCanHave) {
  json experiment = minimal();
  experiment["name"] = std::string(255, 'n');
  EXPECT_EQ(faults_of(experiment), Lines{});
  experiment["name"] = std::string(256, 'n');
  EXPECT_EQ(faults_of(experiment),
            Lines{"/name: expected a name of at most 255 bytes, found one of 256"});
}

TEST_F(Extends, RefusesCyclesAndMissingFiles) {
  folder_.write("a.json", R"({"extends": "b.json"})");
  folder_.write("b.json", R"({"extends": "a.json"})");
  // One line each: what the keys would be is not known without the other file.
  ASSERT_EQ(faults_of("a.json").size(), 1U);
  EXPECT_EQ(faults_of("a.json").front(), "b.json: /extends: expected another file, found " +
                                             (folder_.path() / "a.json").string() +
                                             ", which extends this one");
  folder_.write("c.json", R"({"extends": ")" + std::string(300, 'a') + R"("})");
  ASSERT_EQ(faults_of("c.json").size(), 1U);
  EXPECT_NE(faults_of("c.json").front().find(": File name too long"), std::string::npos);
  folder_.write("c.json", R"({"extends": "none.json"})");
  EXPECT_EQ(faults_of("c.json").size(), 1U);
  EXPECT_EQ(faults_of("c.json").front(),
            "c.json: /extends: expected an experiment file, found none at " +
                (folder_.path() / "none.json").string() + "; known: a.json, b.json, c.json");
  folder_.write("c.json", R"({"extends": "bb.json"})");
  EXPECT_EQ(faults_of("c.json").front(),
            "c.json: /extends: expected an experiment file, found none at " +
                (folder_.path() / "bb.json").string() + "; did you mean \"" +
                (folder_.path() / "b.json").string() + "\"?");
  ASSERT_EQ(::mkfifo((folder_.path() / "pipe.json").c_str(), 0600), 0);
  folder_.write("p.json", R"({"extends": "pipe.json"})");
  EXPECT_EQ(
      faults_of("p.json").front(),
      "p.json: /extends: expected an experiment file, found something that is not a file at " +
          (folder_.path() / "pipe.json").string());
  folder_.write("d.json", R"({"extends": 1})");
  EXPECT_EQ(faults_of("d.json").size(), 1U);
  EXPECT_EQ(faults_of("d.json").front(), "d.json: /extends: expected a string, found 1");
  folder_.write("list.json", "[]");
  folder_.write("e.json", R"({"extends": "list.json"})");
  EXPECT_EQ(faults_of("e.json").size(), 1U);
  EXPECT_EQ(faults_of("e.json").front(), "list.json: /: expected an object");
  folder_.write("0.json", minimal().dump());
  for (int i = 1; i <= 20; ++i) {
    folder_.write(std::to_string(i) + ".json",
                  R"({"extends": ")" + std::to_string(i - 1) + R"(.json"})");
  }
  EXPECT_EQ(faults_of("15.json"), Lines{});
  EXPECT_EQ(faults_of("20.json").front(),
            "5.json: /extends: expected at most 16 files that extend each other");
}

TEST(ExperimentJson, HasEveryKeyWithItsDefault) {
  const json text = experiment_json(load(minimal()));
  EXPECT_EQ(text["starts"], json::parse(R"({"around": "truth", "rotation_deg": 45,
                                            "translation_m": 0.1, "trials": 50})"));
  EXPECT_EQ(text["seed"], 1);
  EXPECT_EQ(text["success"], json::parse(R"({"rotation_deg": 0.5, "translation_m": 0.1})"));
  EXPECT_EQ(text["variants"][0]["name"], "base");
  EXPECT_EQ(text["variants"][0]["pipeline"][0]["size_m"], 0.01);
}

TEST(ExperimentJson, IsReadAsItWasWritten) {
  json experiment = minimal();
  experiment["description"] = "why";
  experiment["seed"] = 9007199254740992;
  experiment["loops"] = true;
  experiment["success"] = {{"rotation_deg", 1.25}, {"translation_m", 0.2}};
  experiment["starts"] =
      json::parse(R"({"around": "nominal", "sweep": {"translation_m": [0.5, 2], "levels": 9}})");
  const Experiment written = load(experiment);
  const Experiment read = read_experiment_json(experiment_json(written), "store");
  EXPECT_EQ(read.name, "x");
  EXPECT_EQ(read.description, "why");
  EXPECT_EQ(read.seed, 9007199254740992U);
  EXPECT_TRUE(read.loops);
  EXPECT_EQ(success_json(read.success), success_json(written.success));
  EXPECT_EQ(deciding_starts_json(read.starts), deciding_starts_json(written.starts));
  EXPECT_EQ(read.dataset.resolved(), json::parse(written.dataset.resolved()).dump());
}

TEST(ExperimentJson, MayHaveNoStarts) {
  json experiment = minimal();
  experiment["starts"] = "none";
  Experiment written = load(experiment);
  EXPECT_EQ(total_trials(written.starts), 1);
  EXPECT_EQ(experiment_json(written)["starts"], "none");
  EXPECT_EQ(deciding_starts_json(written.starts), "\"none\"");
  EXPECT_TRUE(read_experiment_json(experiment_json(written), "store").starts.is_none);
  EXPECT_NO_THROW(set_trials(written.starts, 1));
  EXPECT_THAT(test::input_error([&] { set_trials(written.starts, 2); }),
              ::testing::StartsWith("--trials: expected 1, because trials without"));
  for (const json& wrong : {json("no"), json(3)}) {
    experiment["starts"] = wrong;
    EXPECT_EQ(faults_of(experiment),
              Lines{"/starts: expected an object or \"none\", found " + wrong.dump()});
  }
}

TEST(ExperimentJson, OfAStoreIsReadWithoutItsStages) {
  const Experiment read = read_experiment_json(
      json::parse(R"({"name": "n", "description": "", "dataset": {"type": "gone", "path": "a"},
          "starts": {"around": "truth", "translation_m": 0.1,
                     "sweep": {"rotation_deg": [0, 180], "levels": 1000}, "trials": 1000},
          "seed": 1, "success": {"rotation_deg": 0.5, "translation_m": 0.1},
          "variants": [{"name": "base", "pipeline": [{"name": "a", "step": "gone"}]}],
          "claims": [{"claim": "c", "source": "s", "variant": "base", "statistic": "success",
                      "value": 1, "band": [0, 1]}],
          "quoted": []})"),
      "store");
  ASSERT_TRUE(read.starts.sweep);
  EXPECT_EQ(read.starts.sweep->levels, 1000);
  ASSERT_EQ(read.claims.size(), 1U);
  EXPECT_EQ(read.claims[0].variant, "base");
  const Experiment of_file =
      read_experiment_json(json::parse(R"({"name": "n", "dataset": {"type": "gone"},
                      "starts": {"file": "a.csv", "sha256": "12", "trials": 3}})"),
                           "store");
  EXPECT_EQ(of_file.starts.file + of_file.starts.sha256, "a.csv12");
}

}  // namespace
}  // namespace croon::experiments
