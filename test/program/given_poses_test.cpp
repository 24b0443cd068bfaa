// Poses of another program are judged like results.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

/// An experiment whose base pipeline is `base`, with the `variants`.
std::string experiment(const std::string& variants, const std::string& base = "identity") {
  return R"({"name": "x", "dataset": {"type": "simulated", "scenes": 2},
             "starts": {"rotation_deg": 1, "translation_m": 0.01, "trials": 6},
             "success": {"rotation_deg": 0.9, "translation_m": 0.1},
             "pipeline": [{"step": ")" +
         base + R"("}], "variants": [)" + variants + "]}";
}

const char* const kGiven = R"({"name": "other", "poses": "poses.csv"})";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class GivenPoses : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Writes the starts of the experiment as poses.csv.
  void write_poses() const {
    folder_.write("base.json", experiment(""));
    const Answer answer = croon("starts " + path("base.json") + " --out " + path("poses.csv"));
    ASSERT_EQ(answer.code, 0) << answer.text;
  }

  /// Runs the experiment with `variants` into the folder `out`.
  Answer run(const std::string& variants, const std::string& options = "") const {
    folder_.write("x.json", experiment(variants));
    return croon("run " + path("x.json") + " --out " + path("out") + " --quiet " + options);
  }

  /// The rows of trials.csv of `variant`, without its name.
  std::vector<std::string> trials(const std::string& variant) const {
    std::vector<std::string> rows;
    for (const std::string& line : lines_of(read_whole_file(path("out/trials.csv")))) {
      if (line.compare(0, variant.size() + 1, variant + ",") == 0) {
        rows.push_back(line.substr(variant.size()));
      }
    }
    return rows;
  }

  test::TempFolder folder_;
};

std::size_t count_of(const std::vector<std::string>& rows, const std::string& word) {
  std::size_t count = 0;
  for (const std::string& row : rows) count += row.find("," + word + ",") != std::string::npos;
  return count;
}

TEST_F(GivenPoses, AreJudgedLikeThoseOfAPipeline) {
  write_poses();
  const Answer answer = run(kGiven);
  EXPECT_EQ(answer.code, 0) << answer.text;
  const std::vector<std::string> given = trials("other");
  EXPECT_EQ(given, trials("base"));
  EXPECT_GT(count_of(given, "success"), 0U);
  EXPECT_GT(count_of(given, "inaccurate"), 0U);
}

TEST_F(GivenPoses, OfEachSensorServeAllTrials) {
  write_poses();
  std::string bytes;
  for (std::string line : lines_of(read_whole_file(path("poses.csv")))) {
    const std::size_t sensor = line.find(',');
    const std::size_t trial = line.find(',', sensor + 1);
    const std::size_t pose = line.find(',', trial + 1);
    const std::string number = line.substr(trial, pose - trial);
    if (number == ",trial" || number == ",0") bytes += line.erase(trial, pose - trial) + "\n";
  }
  folder_.write("poses.csv", bytes);
  EXPECT_EQ(run(kGiven).code, 0);
  const std::vector<std::string> given = trials("other");
  ASSERT_EQ(given.size(), trials("base").size());
  EXPECT_EQ(given[0], trials("base")[0]);
  // Trials 0 to 5 of the first sensor have the same pose, hence the same row but for the number.
  const auto behind_number = [](const std::string& row) { return row.substr(row.find(",5,") + 3); };
  EXPECT_NE(given[0].find(behind_number(given[5])), std::string::npos) << given[0] << given[5];
}

TEST_F(GivenPoses, OfAFileAreReadOnceForAGrid) {
  write_poses();
  folder_.write("x.json",
                R"({"name": "x", "dataset": {"type": "simulated", "scenes": 2},
          "starts": {"rotation_deg": 1, "translation_m": 0.01, "trials": 2},
          "pipeline": [{"step": "ground_alignment"}],
          "grid": {"ground_alignment.extractor.threshold_m": [0.1, 0.2, 0.3]},
          "variants": [{"name": "given", "poses": "poses.csv",
                        "pipeline": [{"step": "ground_alignment"}]}]})");
  const Answer answer = croon("run " + path("x.json") + " --out " + path("out") + " --quiet");
  EXPECT_EQ(answer.code, 0) << answer.text;
  for (const char* threshold : {"0.1", "0.2", "0.3"}) {
    const std::string name = std::string("/threshold_m=") + threshold;
    EXPECT_EQ(trials("given" + name).size(), trials("base" + name).size());
  }
  const auto manifest = nlohmann::json::parse(read_whole_file(path("out/manifest.json")));
  EXPECT_EQ(manifest.at("experiment_files").size(), 2U);
}

TEST_F(GivenPoses, ThatAreMissingAreFailedTrials) {
  write_poses();
  std::string bytes = read_whole_file(path("poses.csv"));
  bytes.erase(bytes.rfind('\n', bytes.size() - 2) + 1);
  folder_.write("poses.csv", bytes);
  const Answer answer = run(kGiven);
  EXPECT_EQ(answer.code, 3);
  EXPECT_NE(answer.text.find("poses: the file has no pose for this trial"), std::string::npos)
      << answer.text;
  EXPECT_EQ(count_of(trials("other"), "failed"), 1U);
}

TEST_F(GivenPoses, AreTheStartOfAPipelineBesideThem) {
  write_poses();
  const std::string steps = R"("pipeline": [{"step": "ground_alignment"}])";
  folder_.write("x.json", experiment(R"({"name": "further", "poses": "poses.csv", )" + steps + "}",
                                     "ground_alignment"));
  EXPECT_EQ(croon("run " + path("x.json") + " --out " + path("out") + " --quiet").code, 0);
  const auto error_of = [](const std::string& row) { return row.substr(0, row.find("ground_")); };
  const std::vector<std::string> given = trials("further"), base = trials("base");
  ASSERT_EQ(given.size(), base.size());
  for (std::size_t i = 0; i < base.size(); ++i) EXPECT_EQ(error_of(given[i]), error_of(base[i]));
}

TEST_F(GivenPoses, DecideByTheirBytesWhetherARunGoesOn) {
  write_poses();
  const std::string bytes = read_whole_file(path("poses.csv"));
  EXPECT_EQ(run(kGiven).code, 0);
  const std::string manifest = read_whole_file(path("out/manifest.json"));
  EXPECT_NE(manifest.find("\"path\": \"poses.csv\""), std::string::npos) << manifest;
  // Under another name it is the same file.
  folder_.write("named.csv", bytes);
  EXPECT_EQ(run(R"({"name": "other", "poses": "named.csv"})").code, 0);
  folder_.write("poses.csv", bytes.substr(0, bytes.rfind('\n', bytes.size() - 2) + 1));
  const Answer answer = run(kGiven);
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("other"), std::string::npos) << answer.text;
}

TEST_F(GivenPoses, AreReadStrictly) {
  write_poses();
  const auto refusal = [&](const std::string& variants) {
    const Answer answer = run(variants);
    EXPECT_EQ(answer.code, 2) << answer.text;
    return answer.text;
  };
  EXPECT_NE(refusal(R"({"name": "other", "poses": "none.csv"})")
                .find("x.json: /variants/0/poses: expected a file of poses, found neither "),
            std::string::npos);
  const std::string bytes = read_whole_file(path("poses.csv"));
  folder_.write("poses.csv", bytes + "000000,frnt,0,1,2,3,0,0,0,1\n");
  EXPECT_NE(refusal(kGiven).find("did you mean \"front\"?"), std::string::npos);
  folder_.write("poses.csv", bytes + lines_of(bytes)[1] + "\n");
  EXPECT_NE(refusal(kGiven).find("expected each pose once"), std::string::npos);
  folder_.write("poses.csv", "scene,sensor\n");
  EXPECT_NE(refusal(kGiven).find("poses.csv: line 1: expected \"scene,sensor,trial"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "other", "poses": "p.csv", "pipeline": [{"step": "identity",
                                                                         "name": "poses"}]})")
                .find("two steps are called \"poses\""),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(GivenPoses, StayInTheFolderOfTheExperiment) {
  write_poses();
  folder_.write("inner/x.json", experiment(R"({"name": "other", "poses": "../poses.csv"})"));
  const Answer answer = croon("run " + path("inner/x.json") + " --out " + path("out") + " --quiet");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("/variants/0/poses: expected a file of poses, found "),
            std::string::npos)
      << answer.text;
  EXPECT_NE(answer.text.find(", which is outside the folder "), std::string::npos) << answer.text;
}

}  // namespace
}  // namespace croon::experiments
