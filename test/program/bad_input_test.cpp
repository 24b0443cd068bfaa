#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "test/program/program.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

std::string pcd_header(const std::string& width, const std::string& data) {
  return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + width +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + width + "\nDATA " + data + "\n";
}

std::string ascii_pcd(const Points& cloud) {
  std::ostringstream text;
  text << pcd_header(std::to_string(cloud.size()), "ascii");
  for (const Eigen::Vector3f& p : cloud) text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

const char* const kExperiment = R"({
  "name": "e",
  "dataset": {"type": "opencalib", "path": "rig"},
  "starts": {"around": "truth", "rotation_deg": 5, "translation_m": 0.1, "trials": 1},
  "pipeline": [
    {"step": "ground_alignment", "extractor": {"type": "ransac", "threshold_m": 0.2}},
    {"step": "registration", "icp": {"type": "icpn"}}
  ],
  "variants": [{"name": "plane", "replace": {"registration.icp": {"type": "point_to_plane"}}}]
})";

/// A rig of two LiDARs in a street, and an experiment on it that works.
class BadInput : public testing::Test {
 protected:
  BadInput() {
    Rng rng = test::test_rng();
    folder_.write("data/rig/s1/top.pcd", ascii_pcd(test::random_street(rng, 1, 4000, 0.01)));
    folder_.write("data/rig/s1/left.pcd", ascii_pcd(test::random_street(rng, 1, 2000, 0.01)));
    folder_.write("data/rig/s1/lidar_cloud_path.txt",
                  "device_id: 0\npath: rig/s1/top.pcd\ndevice_id: 1\npath: rig/s1/left.pcd\n");
    folder_.write("data/rig/truth.json",
                  R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
    folder_.write("e.json", kExperiment);
  }

  /// Writes the experiment with `from` replaced by `to`.
  void edit(const std::string& from, const std::string& to) {
    folder_.write("e.json", replaced(kExperiment, from, to));
  }

  /// Runs the experiment into the folder `out` of the test's.
  Answer run(const std::string& options = "", const std::string& out = "out") {
    const std::string root = folder_.path().string();
    return croon("run " + root + "/e.json --data " + root + "/data --quiet --out " + root + "/" +
                 out + " " + options);
  }

  /// The request is refused with exactly `lines` (each after "croon: " and the experiment's path
  /// where it begins with ": "), and nothing is written.
  void expect_refused(const std::vector<std::string>& lines, const std::string& options = "") {
    const Answer answer = run(options);
    EXPECT_EQ(answer.code, 2) << answer.text;
    std::string expected;
    for (const std::string& line : lines) {
      const bool is_of_experiment = line.compare(0, 2, ": ") == 0;
      expected +=
          "croon: " + (is_of_experiment ? folder_.path().string() + "/e.json" : "") + line + "\n";
    }
    EXPECT_EQ(answer.text, expected);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  }

  /// The request is refused with one line that holds each of `parts`, and nothing is written.
  void expect_refused_with(const std::vector<std::string>& parts, const std::string& options = "") {
    const Answer answer = run(options);
    EXPECT_EQ(answer.code, 2) << answer.text;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    EXPECT_EQ(answer.text.rfind("croon: ", 0), 0U) << answer.text;
    for (const std::string& part : parts) {
      EXPECT_NE(answer.text.find(part), std::string::npos) << part << "\n" << answer.text;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  }

  /// The run is done, every trial is `failed`, and the reason that is shown holds `part`.
  void expect_failed_trials(const std::string& part) {
    const Answer answer = run();
    EXPECT_EQ(answer.code, 3) << answer.text;
    EXPECT_NE(answer.text.find(part), std::string::npos) << answer.text;
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "trials.csv"));
  }

  const test::TempFolder folder_;
};

TEST_F(BadInput, NoneOfIt) {
  const Answer answer = run();
  EXPECT_EQ(answer.code, 0) << answer.text;
}

TEST_F(BadInput, MissingExperiment) {
  std::filesystem::remove(folder_.path() / "e.json");
  expect_refused({": expected a readable file, found none"});
}

TEST_F(BadInput, ExperimentIsAFolder) {
  std::filesystem::remove(folder_.path() / "e.json");
  std::filesystem::create_directory(folder_.path() / "e.json");
  expect_refused_with({"e.json: "});
}

TEST_F(BadInput, NotJson) {
  folder_.write("e.json", "{\n  \"name\": oops\n}");
  expect_refused_with({"e.json: expected JSON, found: parse error at line 2, column 11"});
}

TEST_F(BadInput, NotAnObject) {
  folder_.write("e.json", "[1, 2]");
  expect_refused({": /: expected an object, found [1,2]"});
}

TEST_F(BadInput, MisspeltKey) {
  edit("\"starts\"", "\"strats\"");
  expect_refused({": /strats: unknown key \"strats\"; did you mean \"starts\"?"});
}

TEST_F(BadInput, MisspeltFolderOfTheData) {
  const std::string root = folder_.path().string() + "/data/";
  const std::string none = ": expected a file or folder, found none";
  edit("\"path\": \"rig\"", "\"path\": \"rgi\"");
  expect_refused({": /dataset/path: " + root + "rgi" + none + "; did you mean \"rig\"?"});
  edit("\"path\": \"rig\"", "\"path\": \"rig/s2/left\"");
  expect_refused(
      {": /dataset/path: " + root + "rig/s2/left" + none + "; did you mean \"rig/s1\"?"});
  edit("\"path\": \"rig\"", "\"path\": \"another\"");
  expect_refused({": /dataset/path: " + root + "another" + none + "; known: rig"});
  edit("\"path\": \"rig\"", "\"path\": \"../other\"");
  expect_refused_with({"e.json: /dataset/path: ", "is outside the data root"});
}

TEST_F(BadInput, MisspeltFiles) {
  folder_.write("poses.csv", "");
  edit(R"("around": "truth", "rotation_deg": 5, "translation_m": 0.1, "trials": 1)",
       R"("file": "psoes.csv")");
  expect_refused_with({"e.json: /starts/file: ", "found neither ", "did you mean \"poses.csv\"?"});
  edit("\"replace\": {\"registration.icp\": {\"type\": \"point_to_plane\"}}",
       "\"poses\": \"pose.csv\"");
  expect_refused_with({"e.json: /variants/0/poses: ", "did you mean \"poses.csv\"?"});
  // Nothing is said of what is outside the folders.
  edit("\"replace\": {\"registration.icp\": {\"type\": \"point_to_plane\"}}",
       "\"poses\": \"../pose.csv\"");
  EXPECT_EQ(run().text.find("did you mean"), std::string::npos);
  folder_.write("base.json", kExperiment);
  folder_.write("e.json", R"({"extends": "bsae.json"})");
  expect_refused_with({"e.json: /extends: ", "did you mean \"", "base.json\"?"});
}

TEST_F(BadInput, UnknownStage) {
  edit("\"icpn\"", "\"icpm\"");
  expect_refused(
      {": /pipeline/1/icp/type: expected an icp, found \"icpm\"; did you mean \"icpn\"?"});
}

TEST_F(BadInput, MoreStepsThanAMethodHas) {
  std::string steps;
  for (int i = 0; i < 200000; ++i) steps += R"({"step": "x)" + std::to_string(i) + R"("}, )";
  edit(R"({"step": "ground_alignment")", steps + R"({"step": "ground_alignment")");
  expect_refused({": /pipeline: expected a list of at most 1000 steps, found 200002",
                  ": /variants/0/replace/registration.icp: there is no step \"registration\""});
}

TEST_F(BadInput, DuplicateKeyAndAnotherFault) {
  edit("\"trials\": 1", "\"trials\": 1, \"trials\": 0");
  expect_refused({": /starts/trials: duplicate key \"trials\"",
                  ": /starts/trials: expected a whole number from 1 to 1000000, found 0"});
}

TEST_F(BadInput, TwoFaultsAtOnce) {
  folder_.write("e.json",
                replaced(replaced(kExperiment, "\"icpn\"", "\"icpm\""), "\"truth\"", "\"truht\""));
  expect_refused(
      {": /starts/around: expected one of truth, nominal, initial, found \"truht\"; did you "
       "mean \"truth\"?",
       ": /pipeline/1/icp/type: expected an icp, found \"icpm\"; did you mean \"icpn\"?"});
}

TEST_F(BadInput, ReplacementOfAStepThatIsNotThere) {
  edit("\"registration.icp\"", "\"registraton.icp\"");
  expect_refused_with(
      {": /variants/0/replace/registraton.icp: ", "did you mean \"registration\"?"});
}

TEST_F(BadInput, FaultInsideAReplacement) {
  edit("\"point_to_plane\"}", "\"point_to_plane\", \"kernel\": \"hubert\"}");
  expect_refused_with({": /variants/0/replace/registration.icp/kernel: expected one of none, huber",
                       "did you mean \"huber\"?"});
}

TEST_F(BadInput, NameThatIsNoFolder) {
  edit("\"name\": \"e\"", "\"name\": \"../e\"");
  expect_refused_with({": /name: expected a name for a folder", "found \"../e\""});
}

TEST_F(BadInput, CloudOfTheListIsMissing) {
  std::filesystem::remove(folder_.path() / "data/rig/s1/left.pcd");
  expect_refused_with({"rig/s1/lidar_cloud_path.txt: ", "left.pcd"});
}

TEST_F(BadInput, NoStartsForASensor) {
  folder_.write("data/rig/truth.json", "{}");
  expect_refused_with({": /starts/around: sensor \"left\" has no truth"});
}

TEST_F(BadInput, MisspeltSensorOfTheTruth) {
  folder_.write("data/rig/truth.json",
                R"({"lfet": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  expect_refused_with(
      {"data/rig/truth.json: /lfet: expected a sensor of scene s1, found \"lfet\"; "
       "did you mean \"left\", which has no true pose"});
}

TEST_F(BadInput, MisspeltSensorOfTheTruthWithStartsAroundOtherPoses) {
  folder_.write("data/rig/truth.json",
                R"({"lfet": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  folder_.write("data/rig/nominal.json",
                R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  edit(R"("around": "truth")", R"("around": "nominal")");
  expect_refused_with({"data/rig/truth.json: /lfet: expected a sensor of scene s1"});
}

TEST_F(BadInput, TruthOfOtherSensorsAlone) {
  folder_.write("data/rig/truth.json",
                R"({"back": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  expect_refused_with({": /starts/around: sensor \"left\" has no truth"});
}

TEST_F(BadInput, FaultyTruth) {
  folder_.write("data/rig/truth.json",
                R"({"left": {"rotation_rpy_deg": [0, 0], "translation_m": [0, 0, 0]}})");
  expect_refused_with({"truth.json: /left/rotation_rpy_deg: expected"});
}

TEST_F(BadInput, EmptyFileForACloud) {
  folder_.write("data/rig/s1/left.pcd", "");
  expect_refused_with({"rig/s1/left.pcd: "});
}

TEST_F(BadInput, CloudOfAnUnknownFormat) {
  folder_.write("data/rig/s1/left.laz", "LASF");
  folder_.write("data/rig/s1/lidar_cloud_path.txt",
                "device_id: 0\npath: rig/s1/top.pcd\ndevice_id: 1\npath: rig/s1/left.laz\n");
  expect_refused_with({"left.laz: ", "pdal"});
}

TEST_F(BadInput, PcdWhoseCountsDisagree) {
  folder_.write("data/rig/s1/left.pcd",
                replaced(pcd_header("2", "ascii"), "POINTS 2", "POINTS 3") + "1 2 3\n4 5 6\n");
  expect_refused_with({"rig/s1/left.pcd: ", "POINTS"});
}

TEST_F(BadInput, Shards) {
  for (const char* shard :
       {"0/2", "3/2", "1/0", "-1/2", "1/2/3", "a/b", "1", "/", "1.5/2", "1/99999999999"}) {
    expect_refused_with(
        {"--shard: expected K/N with 1 <= K <= N, found \"" + std::string(shard) + "\""},
        "--shard=" + std::string(shard));
  }
}

TEST_F(BadInput, EmptyPaths) {
  for (const char* option : {"--out", "--data"}) {
    expect_refused_with({std::string(option) + ": expected a path, found \"\""},
                        std::string(option) + " \"\"");
  }
}

TEST_F(BadInput, AHugeShardHoldsOneTrial) {
  const Answer answer = run("--shard 2/2147483647 --trials 3");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find(" 1/1 "), std::string::npos) << answer.text;
}

TEST_F(BadInput, AKeyWithALineBreakIsOneLine) {
  edit("\"starts\"", "\"sta\\nrts\"");
  expect_refused_with({"unknown key \"sta?rts\""});
}

TEST_F(BadInput, UnknownVariant) {
  expect_refused({"--only: there is no variant \"plan\"; did you mean \"plane\"?"}, "--only plan");
}

TEST_F(BadInput, AClaimOfNoSensor) {
  edit(R"("starts")",
       R"("claims": [{"claim": "c", "source": "s", "sensor": "lift", "statistic": "success",
                      "value": 1, "band": [0, 1]}], "starts")");
  expect_refused(
      {": /claims/0/sensor: expected a sensor of the dataset, found \"lift\"; did you mean "
       "\"left\"?"});
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  folder_.write("file", "");
  const Answer answer = run("", "file/out");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("/file/out: expected a folder to write to"), std::string::npos)
      << answer.text;
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
}

TEST_F(BadInput, OutputWhereAFolderStands) {
  folder_.write("other/trials.csv/x", "");
  const Answer answer = run("", "other");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "croon: " + folder_.path().string() +
                             "/other/trials.csv: expected a file or nothing, found a folder\n");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "other/store.sqlite"));
}

TEST_F(BadInput, FaultsOfSeveralOptions) {
  expect_refused({"--only: there is no variant \"plan\"; did you mean \"plane\"?",
                  "--shard: expected K/N with 1 <= K <= N, found \"3/2\""},
                 "--only plan --shard 3/2");
}

TEST_F(BadInput, ResultsOfAnotherExperiment) {
  ASSERT_EQ(run().code, 0);
  edit("\"rotation_deg\": 5", "\"rotation_deg\": 6");
  const Answer answer = run();
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("--fresh"), std::string::npos) << answer.text;
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
}

TEST_F(BadInput, EmptyCloudFailsItsTrials) {
  folder_.write("data/rig/s1/left.pcd", pcd_header("0", "ascii"));
  expect_failed_trials("the cloud of left: it has no points");
}

TEST_F(BadInput, CloudOfNanFailsItsTrials) {
  folder_.write("data/rig/s1/left.pcd", pcd_header("2", "ascii") + "nan nan nan\nnan 1 2\n");
  expect_failed_trials("the cloud of left: it has no points");
}

TEST_F(BadInput, ThreePointsFailTheirTrials) {
  folder_.write("data/rig/s1/left.pcd", ascii_pcd({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  expect_failed_trials("only ");
}

TEST_F(BadInput, EqualPointsFailTheirTrials) {
  folder_.write("data/rig/s1/left.pcd", ascii_pcd(Points(500, {1, 2, 3})));
  expect_failed_trials("ground_alignment: ");
}

TEST_F(BadInput, AFaultInTheBodyFailsItsTrials) {
  folder_.write("data/rig/s1/left.pcd", pcd_header("2", "ascii") + "1 2 3\n1 oops 3\n");
  expect_failed_trials("oops");
}

}  // namespace
}  // namespace croon::experiments
