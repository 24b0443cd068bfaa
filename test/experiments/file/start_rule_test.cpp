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
std::pair<StartRule, Lines> read(const std::string& starts) {
  const json root = {{"starts", json::parse(starts)}};
  const Catalogue catalogue = test::fake_catalogue();
  std::vector<Fault> faults;
  const StartRule rule = read_start_rule(params::Node(root, "", faults), catalogue);
  Lines lines;
  for (const Fault& fault : faults) lines.push_back(fault.line());
  return {rule, lines};
}

TEST(StartRule, IsReadWithASweep) {
  const auto [rule, faults] = read(
      R"({"around": "nominal", "sweep": {"rotation_deg": [0, 180], "levels": 19}, "trials": 20})");
  EXPECT_EQ(faults, Lines{});
  ASSERT_TRUE(rule.sweep);
  EXPECT_EQ(rule.trials, 380);
  EXPECT_EQ(level_size(*rule.sweep, 0), 0.0);
  EXPECT_EQ(level_size(*rule.sweep, 1), 10.0);
  EXPECT_EQ(level_size(*rule.sweep, 18), 180.0);
  EXPECT_EQ(level_of(*rule.sweep, 20), 1);
}

TEST(StartRule, NamesAFile) {
  const auto [rule, faults] = read(R"({"file": "starts.csv"})");
  EXPECT_EQ(faults, Lines{});
  EXPECT_EQ(rule.file, "starts.csv");
  EXPECT_EQ(rule.trials, 0);
  EXPECT_EQ(read(R"({"file": "starts.csv", "trials": 3})").first.trials, 3);
}

TEST(StartRule, NamesWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"file": "a", "around": "truth"})",
       "/starts/around: expected no key but \"trials\" beside \"file\", found \"around\""},
      {R"({"file": ""})", "/starts/file: expected"},
      {R"({"file": "a", "trials": 0})", "/starts/trials: expected a whole number from 1"},
      {R"({"sweep": 1})", "/starts/sweep: expected an object, found 1"},
      {R"({"sweep": {}})", "/starts/sweep: expected one of \"rotation_deg\" and \"translation_m\""},
      {R"({"sweep": {"rotation_deg": [0, 1], "translation_m": [0, 1]}})",
       "/starts/sweep: expected one of"},
      {R"({"sweep": {"rotation_deg": [0, 181]}})", "/starts/sweep/rotation_deg"},
      {R"({"sweep": {"rotation_deg": [10]}})",
       "/starts/sweep/rotation_deg: expected two numbers, the smaller first, found [10]"},
      {R"({"sweep": {"rotation_deg": [10, 10]}})", "/starts/sweep/rotation_deg: expected two"},
      {R"({"sweep": {"rotation_deg": [0, 1], "levels": 1}})",
       "/starts/sweep/levels: expected a whole number from 2 to 1000, found 1"},
      {R"({"sweep": {"rotation_deg": [0, 1]}, "rotation_deg": 5})",
       "/starts/rotation_deg: expected no \"rotation_deg\" beside a sweep of it"},
      {R"({"sweep": {"rotation_deg": [0, 1], "levels": 100}, "trials": 10001})",
       "/starts/trials: expected a whole number from 1 to 10000 of each of the 100 levels"}};
  for (const auto& [starts, message] : cases) {
    const Lines faults = read(starts).second;
    ASSERT_EQ(faults.size(), 1U) << starts;
    EXPECT_EQ(faults[0].substr(0, message.size()), message);
  }
}

TEST(StartRule, TellsWhatDecidesAStart) {
  for (const char* starts :
       {R"({"around":"truth","rotation_deg":45,"translation_m":0.1})",
        R"({"around":"nominal","translation_m":2,"sweep":{"rotation_deg":[0,90],"levels":4}})",
        R"({"around":"truth","rotation_deg":7,"sweep":{"translation_m":[0.5,2],"levels":9}})"}) {
    const StartRule rule = read(starts).first;
    EXPECT_EQ(starts_json(rule), starts);
    const std::optional<Sweep> sweep = sweep_of_json(json::parse(starts));
    ASSERT_EQ(sweep.has_value(), rule.sweep.has_value());
    if (!sweep) continue;
    EXPECT_EQ(sweep->of, rule.sweep->of);
    EXPECT_EQ(sweep->first, rule.sweep->first);
    EXPECT_EQ(sweep->last, rule.sweep->last);
    EXPECT_EQ(sweep->levels, rule.sweep->levels);
  }
  StartRule rule = read(R"({"file": "a.csv"})").first;
  StartTable table;
  table.sha256 = "12ab";
  rule.table = std::make_shared<const StartTable>(table);
  EXPECT_EQ(starts_json(rule), R"({"file":"a.csv","sha256":"12ab"})");
}

TEST(StartRule, TakesTrialsPerLevel) {
  StartRule rule = read(R"({"sweep": {"translation_m": [0, 5]}, "trials": 3})").first;
  EXPECT_EQ(rule.trials, 33);
  set_trials(rule, 0);
  EXPECT_EQ(rule.trials, 33);
  set_trials(rule, 4);
  EXPECT_EQ(rule.trials, 44);
  EXPECT_EQ(test::input_error([&] { set_trials(rule, 90910); }),
            "--trials: expected a whole number from 1 to 90909 of each of the 11 levels of the "
            "sweep, found 90910");
}

}  // namespace
}  // namespace croon::experiments
