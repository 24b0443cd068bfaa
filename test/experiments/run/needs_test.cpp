// What steps need, extras and channels, is checked before anything runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/run/channel_check.hpp"
#include "experiments/run/run_request.hpp"
#include "experiments/run/runner.hpp"
#include "registry/help.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The checked run of an experiment with the pipeline and the members `text` beside it.
CheckedRun checked(const std::string& pipeline, const std::string& text = "",
                   const std::string& dataset = "") {
  const test::TempFolder folder;
  RunRequest request;
  request.experiment =
      folder.write("x.json", R"({"name": "x", "dataset": {"type": "fake")" + dataset +
                                 R"(}, "pipeline": )" + pipeline + text + "}");
  return check_run(request, test::fake_catalogue());
}

/// The faults of the same, without the file.
std::vector<std::string> need_faults(const std::string& pipeline, const std::string& text = "",
                                     const std::string& dataset = "") {
  std::vector<std::string> lines;
  try {
    checked(pipeline, text, dataset);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      lines.push_back(Fault{"", fault.where, fault.message}.line());
    }
  }
  return lines;
}

TEST(Extras, AStepReadsWhatAnEarlierOnePut) {
  const CheckedRun run = checked(R"([{"step": "give", "value": 3}, {"step": "take"},
                                     {"step": "give", "name": "again", "value": -1},
                                     {"step": "take", "name": "second"}])");
  RunListener listener;
  int records = 0;
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>&) {
    ++records;
    const CalibratedPair& pair = run.groups.front().pairs.front();
    ASSERT_TRUE(record.T_reference_sensor);
    if (record.id.scene != run.groups.front().name || record.id.sensor != pair.name) return;
    EXPECT_NEAR(record.T_reference_sensor->translation.x(), pair.truth->translation.x() + 2.0, 0.2);
  };
  run_trials(run.experiment, run.groups, plan_trials(run.experiment, run.groups, run.selection), 1,
             listener);
  EXPECT_GT(records, 0);
}

TEST(Extras, AnUnmetNeedIsRefusedWhereTheStepIsWritten) {
  EXPECT_THAT(need_faults(R"([{"step": "take"}])"),
              ElementsAre("/pipeline/0: the step \"take\" needs the extra \"token\" (a distance in "
                          "metres), which no earlier step provides, in variant \"base\""));
  EXPECT_THAT(need_faults(R"([{"step": "take"}, {"step": "give"}])"),
              ElementsAre(HasSubstr("/pipeline/0: the step \"take\" needs")));
  EXPECT_THAT(need_faults(R"([{"step": "give_other"}, {"step": "take"}])"),
              ElementsAre(HasSubstr("which an earlier step provides with another type")));
  EXPECT_THAT(need_faults(R"([{"step": "give"}, {"step": "take"}])"), ElementsAre());
}

TEST(Extras, AVariantThatRemovesWhatGivesIsNamed) {
  EXPECT_THAT(need_faults(R"([{"step": "give"}, {"step": "take"}])",
                          R"(, "variants": [{"name": "without", "remove": ["give"]}])"),
              ElementsAre(HasSubstr("in variant \"without\"")));
}

TEST(Extras, HelpSaysWhatStepsNeedAndProvide) {
  const Catalogue catalogue = test::fake_catalogue();
  const auto page = [&](const char* which, HelpFormat format) {
    return stages_help(catalogue, which, format);
  };
  EXPECT_THAT(page("step/give", HelpFormat::text),
              HasSubstr("  Provides the extra token, a distance in metres.\n"));
  EXPECT_THAT(page("step/take", HelpFormat::markdown),
              HasSubstr("\nNeeds the extra `token`, a distance in metres.\n"));
  EXPECT_THAT(page("step/need", HelpFormat::text), HasSubstr("  Needs the channel time.\n"));
  const auto parsed = nlohmann::json::parse(page("step/need", HelpFormat::json));
  EXPECT_EQ(parsed[0]["needs"].dump(), R"([{"channel":"ring"},{"channel":"time"}])");
}

TEST(Channels, ThatAStepNeedsAreKept) {
  EXPECT_EQ(
      needed_channels(
          checked(R"([{"step": "need"}])", "", R"(, "channels": ["ring", "time"])").experiment),
      (std::set<std::string>{"ring", "time"}));
  EXPECT_TRUE(needed_channels(checked(R"([{"step": "give"}])").experiment).empty());
}

TEST(Channels, ThatAreMissingAreRefusedBeforeTheRun) {
  EXPECT_THAT(need_faults(R"([{"step": "need"}])", "", R"(, "channels": ["ring", "time"])"),
              ElementsAre());
  EXPECT_THAT(
      need_faults(R"([{"step": "need"}])", "", R"(, "channels": ["ring"], "sensors": 1)"),
      ElementsAre("expected the channel \"time\" in the cloud of sensor \"s0\", which the step "
                  "\"need\" of variant \"base\" needs; found ring (and the same in 1 more scene)"));
  EXPECT_THAT(need_faults(R"([{"step": "need"}])", "", R"(, "sensors": 2, "scenes": 1)"),
              ElementsAre(HasSubstr("\"ring\" in the cloud of sensor \"s0\""),
                          HasSubstr("\"time\" in the cloud of sensor \"s0\""),
                          HasSubstr("\"ring\" in the cloud of sensor \"s1\""),
                          HasSubstr("found no channel")));
}

}  // namespace
}  // namespace croon::experiments
