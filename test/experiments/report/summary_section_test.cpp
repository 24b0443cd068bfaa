#include "experiments/report/result_sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "framework/base/text.hpp"
#include "framework/document/renderers.hpp"
#include "test/experiments/support/summary_text.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;

// Checked by hand: x of base/left is 0, 1, 2 cm in one scene and 0, -1, -2 cm in the other.
constexpr const char* kTableOfFewRecords =
    R"(variant    sensor  success      %  95 % interval  inaccurate  rejected  failed  rotation deg   translation m
---------  ------  -------  -----  -------------  ----------  --------  ------  ------------  --------------
base       left        6/8   75.0              -           1         0       1  0.024, 0.035  0.0104, 0.0202
base       right       6/7   85.7              -           0         1       0  0.024, 0.035  0.0104, 0.0202
no volume  left        6/8   75.0              -           1         0       1  0.035, 0.060  0.0202, 0.0401
no volume  right       6/6  100.0              -           0         0       0  0.035, 0.060  0.0202, 0.0401
Success: within 0.5 deg and 0.1 m of ground truth; errors are over these trials.
Rotation, translation: median, 95th percentile.
No interval: trials of one scene are dependent, and there are fewer than 6 scenes.

Frames
Scenes in which every trial of every sensor succeeds.
variant    frames    %  95 % interval
---------  ------  ---  -------------
base          0/2  0.0              -
no volume     0/2  0.0              -

Errors: mean ± std
variant    sensor      pitch deg      roll deg       yaw deg             x m             y m             z m
---------  ------  -------------  ------------  ------------  --------------  --------------  --------------
base       left    -0.010 ±0.009  0.000 ±0.022  0.010 ±0.009  0.0000 ±0.0141  0.0000 ±0.0000  0.0030 ±0.0000
base       right   -0.010 ±0.009  0.000 ±0.022  0.010 ±0.009  0.0000 ±0.0141  0.0000 ±0.0000  0.0030 ±0.0000
no volume  left    -0.020 ±0.018  0.000 ±0.022  0.020 ±0.018  0.0000 ±0.0283  0.0000 ±0.0000  0.0030 ±0.0000
no volume  right   -0.020 ±0.018  0.000 ±0.022  0.020 ±0.018  0.0000 ±0.0283  0.0000 ±0.0000  0.0030 ±0.0000

Std within scenes / across scenes
variant    sensor      pitch deg       roll deg        yaw deg              x m              y m              z m
---------  ------  -------------  -------------  -------------  ---------------  ---------------  ---------------
base       left    0.010 / 0.000  0.000 / 0.028  0.010 / 0.000  0.0100 / 0.0141  0.0000 / 0.0000  0.0000 / 0.0000
base       right   0.010 / 0.000  0.000 / 0.028  0.010 / 0.000  0.0100 / 0.0141  0.0000 / 0.0000  0.0000 / 0.0000
no volume  left    0.020 / 0.000  0.000 / 0.028  0.020 / 0.000  0.0200 / 0.0283  0.0000 / 0.0000  0.0000 / 0.0000
no volume  right   0.020 / 0.000  0.000 / 0.028  0.020 / 0.000  0.0200 / 0.0283  0.0000 / 0.0000  0.0000 / 0.0000

Comparison with base
Paired by trial: median difference [95 % interval over scenes]; failures are infinite errors.
variant    pairs  won  lost      p  rotation deg       p  translation m       p
---------  -----  ---  ----  -----  ------------  ------  -------------  ------
no volume     14    0     0  1.000        0.0101  0.023*        0.00978  0.023*
* p < 0.05 over trials (McNemar, Wilcoxon; Holm), ** also with scenes as units.

Success per scene
variant    scene  left  right
---------  -----  ----  -----
base       0001    3/4    3/3
base       0002    3/4    3/4
no volume  0001    3/4    3/3
no volume  0002    3/4    3/3

Reported reasons
variant    status    reason                                         trials
---------  --------  ---------------------------------------------  ------
base       rejected  two yaws fit                                        1
base       failed    ground_alignment: no plane, "nothing" is flat       1
no volume  failed    ground_alignment: no plane, "nothing" is flat       1
)";

TEST(SummaryTable, ShowsWhatAResearcherLooksForFirst) {
  EXPECT_EQ(test::summary_text(summarise(test::few_records(), kBounds, {})), kTableOfFewRecords);
}

TEST(SummaryTable, KeepsWithin120Columns) {
  std::istringstream text(test::summary_text(summarise(test::few_records(), kBounds, {})));
  for (std::string line; std::getline(text, line);) EXPECT_LE(text_columns(line), 120U) << line;
}

TEST(SummaryTable, WithoutTruthShowsAgreement) {
  const std::string text = test::summary_text(summarise(test::one_of_four_astray(), kBounds, {}));
  EXPECT_NE(text.find("Agreement (no ground truth)"), std::string::npos);
  EXPECT_EQ(text.find("success"), std::string::npos);
  EXPECT_NE(text.find("\nleft          3/4  75.0"), std::string::npos);
  EXPECT_EQ(text.find("across"), std::string::npos);  // One scene alone.
}

TEST(SummaryTable, ASceneWithoutTruthAmongOthersIsNotJudged) {
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 3; ++trial) {
    for (const TrialRecord& record : test::few_records()) {
      if (record.status != Status::success) continue;
      records.push_back(record);
      records.back().id = {"base", "true", "left", trial};
      break;
    }
    records.push_back(test::finished_without_truth({"base", "untrue", "left", trial}, {}));
  }
  const std::string text = test::summary_text(summarise(records, kBounds, {}));
  EXPECT_NE(text.find("left        3/3  100.0"), std::string::npos) << text;
  EXPECT_EQ(text.find("3/6"), std::string::npos) << text;
  EXPECT_NE(text.find("untrue     -"), std::string::npos) << text;
}

TEST(SummaryTable, LongVariantNamesStandAboveTheirRows) {
  auto records = test::few_records();
  const std::string name = "base, volume_refinement.scorer = openvdb_grid";
  for (TrialRecord& record : records) {
    if (record.id.variant == "no volume") record.id.variant = name;
  }
  const std::string text = test::summary_text(summarise(records, kBounds, {}));
  EXPECT_NE(text.find("\n" + name + "\nleft "), std::string::npos);
  EXPECT_NE(text.find("\nbase\nleft "), std::string::npos);
}

TEST(SummaryTable, OfManyReasonsShowsTheMostFrequent) {
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < 14; ++scene) {
    const std::string name = std::to_string(scene / 2);
    records.push_back(test::unfinished({"base", std::to_string(scene), "left", 0}, Status::failed,
                                       "why " + (scene < 12 ? name : "6" + name)));
  }
  const std::string text = test::summary_text(summarise(records, kBounds, {}));
  EXPECT_NE(text.find("why 0"), std::string::npos);
  EXPECT_EQ(text.find("why 66"), std::string::npos);
  EXPECT_NE(text.find("And 2 other reasons of 4 trials.\n"), std::string::npos) << text;
}

TEST(SummaryTable, OfThousandsOfScenesIsNotLonger) {
  Rng rng = croon::test::test_rng();
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < 2000; ++scene) {
    for (const char* sensor : {"left", "right"}) {
      const TrialId id = {"base", std::to_string(scene), sensor, 0};
      // Both sensors fail in one scene of a hundred alone: those are the worst.
      const bool is_bad = scene % 100 == 7 || (*sensor == 'l' && rng.uniform() < 0.1);
      records.push_back(test::finished(id, is_bad ? Status::inaccurate : Status::success, {},
                                       test::random_offset(rng, 0.1, 0.02)));
    }
  }
  const std::string text = test::summary_text(summarise(records, kBounds, {}));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 40);
  EXPECT_NE(text.find("-----\n1007    0/1    0/1\n107     0/1    0/1\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nThe worst 12 of 2000 rows.\n"), std::string::npos);
  // One trial per scene has no spread within.
  EXPECT_EQ(text.find("within scenes"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(SummaryTable, ColoursOnlyWhereAsked) {
  const Summary summary = summarise(test::few_records(), kBounds, {});
  EXPECT_EQ(test::summary_text(summary).find('\033'), std::string::npos);
  EXPECT_NE(test::summary_text(summary, true).find('\033'), std::string::npos);
}

TEST(SummaryTable, NoTrials) { EXPECT_EQ(test::summary_text(Summary{}), "no trials\n"); }

TEST(PlanSection, ListsWhatIsSaved) {
  const PlanCounts plan = {20, 60, 3, {{"first", 60, 20}, {"second", 60, 40}}};
  EXPECT_EQ(text_section(plan_section(plan)),
            R"(60 trials to run from 20 starts; 3 are in the store
step       one by one  runs  saved  saved %
---------  ----------  ----  -----  -------
first              60    20     40     66.7
second             60    40     20     33.3
all steps         120    60     60     50.0
)");
  EXPECT_EQ(text_section(plan_section({0, 0, 60, {}})),
            "0 trials to run from 0 starts; 60 are in the store\n");
}

}  // namespace
}  // namespace croon::experiments
