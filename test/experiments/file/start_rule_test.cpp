#include "experiments/file/start_rule.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

/// The rule that the text of "starts" describes, and its faults.
std::pair<StartRule, Lines> read_rule(const std::string& starts) {
  const json root = {{"starts", json::parse(starts)}};
  const Catalogue catalogue = test::fake_catalogue();
  std::vector<Fault> faults;
  const params::Node node = params::Node(root, "", faults).member("starts");
  const StartRule rule = start_table().read(node, {}, catalogue);
  Lines lines;
  for (const Fault& fault : faults) lines.push_back(fault.line());
  return {rule, lines};
}

TEST(StartRule, IsReadWithASweep) {
  const auto [rule, faults] = read_rule(
      R"({"around": "nominal", "sweep": {"rotation_deg": [0, 180], "levels": 19}, "trials": 20})");
  EXPECT_EQ(faults, Lines{});
  ASSERT_TRUE(rule.sweep);
  EXPECT_EQ(rule.trials, 20);
  EXPECT_EQ(total_trials(rule), 380);
  EXPECT_EQ(level_size(*rule.sweep, 0), 0.0);
  EXPECT_EQ(level_size(*rule.sweep, 1), 10.0);
  EXPECT_EQ(level_size(*rule.sweep, 18), 180.0);
  EXPECT_EQ(level_of(*rule.sweep, 20), 1);
}

TEST(StartRule, NamesAFile) {
  const auto [rule, faults] = read_rule(R"({"file": "starts.csv"})");
  EXPECT_EQ(faults, Lines{});
  EXPECT_EQ(rule.file, "starts.csv");
  EXPECT_EQ(rule.trials, 0);
  EXPECT_EQ(read_rule(R"({"file": "starts.csv", "trials": 3})").first.trials, 3);
}

TEST(StartRule, NamesWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"file": "a", "around": "truth"})",
       "/starts/around: expected no key but \"trials\" beside \"file\", found \"around\""},
      {R"({"file": ""})", "/starts/file: expected"},
      {R"({"file": "a", "trials": 0})", "/starts/trials: expected a whole number from 1"},
      {R"({"sweep": 1})", "/starts/sweep: expected an object, found 1"},
      {R"({"sha256": "12"})", "/starts/sha256: expected no key \"sha256\" without \"file\""},
      {R"({"sweep": {}})", "/starts/sweep: expected one of \"rotation_deg\" and \"translation_m\""},
      {R"({"sweep": {"rotation_deg": [0, 1], "translation_m": [0, 1]}})",
       "/starts/sweep: expected one of"},
      {R"({"sweep": {"rotation_deg": [0, 181]}})", "/starts/sweep/rotation_deg"},
      {R"({"sweep": {"rotation_deg": [10]}})",
       "/starts/sweep/rotation_deg: expected [low, high] with low at most high, found [10]"},
      {R"({"sweep": {"rotation_deg": [10, 10]}})", "/starts/sweep/rotation_deg: expected two"},
      {R"({"sweep": {"rotation_deg": [0, 1], "levels": 1}})",
       "/starts/sweep/levels: expected a whole number from 2 to 1000, found 1"},
      {R"({"sweep": {"rotation_deg": [0, 1]}, "rotation_deg": 5})",
       "/starts/rotation_deg: expected no \"rotation_deg\" beside a sweep of it"},
      {R"({"sweep": {"rotation_deg": [0, 1], "levels": 100}, "trials": 10001})",
       "/starts/trials: expected a whole number from 1 to 10000 of each of the 100 levels"}};
  for (const auto& [starts, message] : cases) {
    const Lines faults = read_rule(starts).second;
    ASSERT_EQ(faults.size(), 1U) << starts;
    EXPECT_EQ(faults[0].substr(0, message.size()), message);
  }
}

TEST(StartRule, IsWrittenAsItIsRead) {
  for (const char* starts :
       {R"({"around":"truth","rotation_deg":45,"translation_m":0.1})",
        R"({"around":"nominal","translation_m":2,"sweep":{"rotation_deg":[0,90],"levels":4}})",
        R"({"around":"truth","rotation_deg":7,"sweep":{"translation_m":[0.5,2],"levels":9}})"}) {
    EXPECT_EQ(deciding_starts_json(read_rule(starts).first), starts);
  }
  // What a file is called decides nothing, its content does.
  StartRule rule = read_rule(R"({"file": "a.csv"})").first;
  rule.sha256 = "12ab";
  EXPECT_EQ(deciding_starts_json(rule), R"({"file":"*","sha256":"12ab"})");
}

TEST(StartRule, HasRangesPerAxis) {
  const auto [rule, faults] =
      read_rule(R"({"rotation_deg": [1, 2, 30], "translation_m": [0.5, 0, 0.1]})");
  EXPECT_EQ(faults, Lines{});
  EXPECT_EQ(rule.rotation_deg[2], 30.0);
  EXPECT_EQ(rule.translation_m[0], 0.5);
  EXPECT_EQ(deciding_starts_json(rule),
            R"({"around":"truth","rotation_deg":[1,2,30],"translation_m":[0.5,0,0.1]})");
  // Three equal numbers are the same starts as one, and the same results.
  EXPECT_EQ(deciding_starts_json(read_rule(R"({"rotation_deg": [10, 10, 10]})").first),
            deciding_starts_json(read_rule(R"({"rotation_deg": 10})").first));
  EXPECT_EQ(read_rule(R"({"rotation_deg": [1, 2]})").second,
            Lines{"/starts/rotation_deg: expected a number or a list of three, one for each axis, "
                  "found [1,2]"});
  EXPECT_EQ(read_rule(R"({"rotation_deg": [1, 2, 181]})").second,
            Lines{"/starts/rotation_deg/2: expected a number from 0 to 180, found 181"});
}

TEST(StartRule, NamesTheRangeOfWhatNoIntegerHolds) {
  const Lines faults = read_rule(R"({"trials": 1000000000000})").second;
  EXPECT_EQ(faults, Lines{"/starts/trials: expected a whole number from 1 to 1000000, found "
                          "1000000000000"});
}

TEST(StartRule, TakesTrialsPerLevel) {
  StartRule rule = read_rule(R"({"sweep": {"translation_m": [0, 5]}, "trials": 3})").first;
  EXPECT_EQ(total_trials(rule), 33);
  set_trials(rule, 0);
  EXPECT_EQ(total_trials(rule), 33);
  set_trials(rule, 4);
  EXPECT_EQ(total_trials(rule), 44);
  EXPECT_EQ(test::input_error([&] { set_trials(rule, 90910); }),
            "--trials: expected a whole number from 1 to 90909 of each of the 11 levels of the "
            "sweep, found 90910");
}

}  // namespace
}  // namespace croon::experiments
