#include "experiments/analysis/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"
#include "test/experiments/support/summary_text.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::test_rng;
using test::kBounds;

constexpr double kComparisonInf = std::numeric_limits<double>::infinity();

struct TwoVariants {
  int scenes = 12;
  int trials = 4;
  double variant_size = 1.0;   ///< Of its errors, the base's being 1.
  double failure_ratio = 0.2;  ///< Of both variants.
  bool has_truth = true;
};

/// Trials of "base" and "other" on two sensors.
std::vector<TrialRecord> random_records(Rng& rng, const TwoVariants& like) {
  std::vector<TrialRecord> records;
  for (const char* variant : {"base", "other"}) {
    const double size = *variant == 'b' ? 1.0 : like.variant_size;
    for (int scene = 0; scene < like.scenes; ++scene) {
      for (const char* sensor : {"left", "right"}) {
        for (int trial = 0; trial < like.trials; ++trial) {
          const TrialId id = {variant, "s" + std::to_string(scene), sensor, trial};
          const Vector6d offset = test::random_offset(rng, 0.1 * size, 0.02 * size);
          if (rng.uniform() < like.failure_ratio) {
            records.push_back(test::unfinished(id, Status::failed, "no ground"));
          } else if (like.has_truth) {
            records.push_back(test::finished(id, Status::success, {}, offset));
          } else {
            records.push_back(test::finished_without_truth(id, moved({}, offset)));
          }
        }
      }
    }
  }
  return records;
}

std::vector<Comparison> compared(const std::vector<TrialRecord>& records,
                                 const std::vector<std::string>& variants = {"base", "other"}) {
  ReportOrder order;
  order.variants = variants;
  return summarise(records, kBounds, order).comparisons;
}

TEST(Comparison, FewRecordsByHand) {
  const std::vector<Comparison> comparisons = compared(test::few_records(), {});
  ASSERT_EQ(comparisons.size(), 3U);
  EXPECT_EQ(comparisons[0].sensor, "left");
  EXPECT_EQ(comparisons[1].sensor, "right");
  const Comparison& all = comparisons[2];
  EXPECT_EQ(all.sensor, "");
  EXPECT_EQ(all.variant, "no volume");
  EXPECT_EQ(all.base, "base");
  // Of the base's 15 trials the fourth of 0002/right has no partner.
  EXPECT_EQ(all.pairs, 14);
  EXPECT_EQ(all.scenes, 2);
  EXPECT_EQ(all.only_base, 0);
  EXPECT_EQ(all.only_variant, 0);
  EXPECT_EQ(all.success.p, 1.0);
  EXPECT_GT(all.translation_m.difference, 0.0);
  // Equal at trials 0, 3: 8 of 14 pairs differ, all in the base's favour.
  EXPECT_EQ(all.translation_m.test.p, 2.0 / 256.0);
  EXPECT_TRUE(is_significant(all.translation_m.test));
  // Two scenes cannot tell: 2 of 4 signs are as extreme.
  EXPECT_EQ(all.translation_m.test.p_by_scene, 0.5);
  EXPECT_FALSE(is_significant_by_scene(all.translation_m.test));
}

TEST(Comparison, OfOneVariantThereIsNone) {
  auto records = test::few_records();
  records.erase(std::remove_if(records.begin(), records.end(),
                               [](const TrialRecord& r) { return r.id.variant != "base"; }),
                records.end());
  EXPECT_TRUE(compared(records, {}).empty());
  const Summary summary = summarise(records, kBounds, {});
  EXPECT_EQ(summary_json(summary).find("comparison"), std::string::npos);
  EXPECT_EQ(test::summary_text(summary).find("Comparison"), std::string::npos);
}

TEST(Comparison, ByDegreeOfFreedomFindsTheOneThatDiffers) {
  Rng rng = test_rng();
  std::vector<TrialRecord> records;
  for (const char* variant : {"base", "other"}) {
    for (int scene = 0; scene < 20; ++scene) {
      Vector6d offset = test::random_offset(rng, 0.1, 0.02);
      // y alone is ten times as good, whatever its sign.
      if (*variant == 'o') offset(static_cast<Eigen::Index>(Dof::y)) *= 0.1;
      const TrialId id = {variant, "s" + std::to_string(scene), "left", 0};
      records.push_back(scene == 19 ? test::unfinished(id, Status::failed, "no ground")
                                    : test::finished(id, Status::success, {}, offset));
    }
  }
  ReportOrder order;
  order.variants = {"base", "other"};
  const Summary summary = summarise(records, kBounds, order);
  // Of the sensor and of all sensors together.
  ASSERT_EQ(summary.dof_comparisons.size(), 2 * kDofs);
  for (const DofComparison& of : summary.dof_comparisons) {
    EXPECT_EQ(of.pairs, 20);
    EXPECT_EQ(of.scenes, 20);
    const bool is_y = of.dof == static_cast<std::size_t>(Dof::y);
    EXPECT_EQ(is_significant_by_scene(of.error.test), is_y) << kMeasures[of.dof].name;
    if (!is_y) continue;
    EXPECT_TRUE(of.error.test.favours_variant);
    EXPECT_LT(of.error.variant_median, of.error.base_median);
  }
  const std::string csv = csv_of(dof_comparison_columns(), summary.dof_comparisons);
  EXPECT_NE(csv.find("\nother,base,left,y,m,20,20,"), std::string::npos) << csv;
  // Of a size: the sign of an error makes no difference.
  std::vector<TrialRecord> flipped = records;
  for (TrialRecord& record : flipped) {
    if (record.error) record.error->dof = -record.error->dof;
  }
  EXPECT_EQ(csv_of(dof_comparison_columns(), summarise(flipped, kBounds, order).dof_comparisons),
            csv);
}

TEST(Comparison, WithoutCommonTrialsThereIsNone) {
  auto records = test::few_records();
  for (TrialRecord& record : records) record.id.trial += record.id.variant == "base" ? 100 : 0;
  EXPECT_TRUE(compared(records, {}).empty());
}

TEST(Comparison, TheOrderOfRecordsMakesNoDifference) {
  Rng rng = test_rng();
  auto records = random_records(rng, {});
  const auto csv = [](const std::vector<TrialRecord>& from) {
    return csv_of(comparison_columns(), summarise(from, kBounds, {}).comparisons);
  };
  EXPECT_EQ(csv(records), csv(test::shuffled(rng, records)));
}

TEST(Comparison, SwappedVariantsFlipTheDifference) {
  Rng rng = test_rng();
  for (const double size : {1.0, 2.0}) {
    const auto records = random_records(rng, {12, 4, size, 0.3, size > 1.0});
    const auto there = compared(records), back = compared(records, {"other", "base"});
    ASSERT_EQ(there.size(), back.size());
    for (std::size_t i = 0; i < there.size(); ++i) {
      EXPECT_EQ(there[i].only_base, back[i].only_variant);
      EXPECT_EQ(there[i].success.p, back[i].success.p);
      EXPECT_EQ(there[i].success.p_by_scene, back[i].success.p_by_scene);
      for (const auto error : {&Comparison::rotation_deg, &Comparison::translation_m}) {
        const ErrorComparison &a = there[i].*error, &b = back[i].*error;
        EXPECT_EQ(a.difference, -b.difference);
        EXPECT_EQ(a.interval->low, -b.interval->high);
        EXPECT_EQ(a.test.p, b.test.p);
        EXPECT_EQ(a.test.p_by_scene, b.test.p_by_scene);
      }
    }
  }
}

TEST(Comparison, FailuresAreInfiniteNotDropped) {
  Rng rng = test_rng();
  auto records = random_records(rng, {12, 4, 1.0, 0.0, true});
  int count = 0;
  for (TrialRecord& record : records) {
    if (record.id.variant != "other" || ++count % 3 == 0) continue;
    record = test::unfinished(record.id, count % 3 == 1 ? Status::failed : Status::rejected, "no");
  }
  const Comparison all = compared(records).back();
  EXPECT_EQ(all.pairs, 96);
  EXPECT_EQ(all.only_base, 64);
  EXPECT_EQ(all.only_variant, 0);
  EXPECT_EQ(all.rotation_deg.variant_median, kComparisonInf);
  EXPECT_EQ(all.rotation_deg.difference, kComparisonInf);
  EXPECT_EQ(all.rotation_deg.interval->high, kComparisonInf);
  EXPECT_TRUE(is_significant_by_scene(all.rotation_deg.test));
  EXPECT_TRUE(is_significant_by_scene(all.success));
}

TEST(Comparison, FailuresOfEitherSideInHalfOfThePairsAreNoDifference) {
  Rng rng = test_rng();
  auto records = random_records(rng, {12, 4, 1.0, 0.0, true});
  for (TrialRecord& record : records) {
    // Only the base fails in even trials, only the other in odd ones.
    const bool is_even = record.id.trial % 2 == 0;
    if (is_even != (record.id.variant == "base")) continue;
    record = test::unfinished(record.id, Status::failed, "no ground");
  }
  const Comparison all = compared(records).back();
  EXPECT_EQ(all.only_base, all.only_variant);
  EXPECT_EQ(all.success.p, 1.0);
  for (const ErrorComparison& error : {all.rotation_deg, all.translation_m}) {
    EXPECT_EQ(error.difference, 0.0);
    EXPECT_EQ(error.paired_difference, 0.0);
    for (const Interval& interval : {*error.interval, *error.paired_interval}) {
      EXPECT_LE(interval.low, 0.0);
      EXPECT_GE(interval.high, 0.0);
    }
    EXPECT_EQ(error.test.p, 1.0);
    EXPECT_EQ(error.test.p_by_scene, 1.0);
  }
}

TEST(Comparison, WithoutTruthErrorsAreFromTheOwnConsensus) {
  Rng rng = test_rng();
  const auto records = random_records(rng, {20, 6, 3.0, 0.0, false});
  const Comparison all = compared(records).back();
  EXPECT_GT(all.rotation_deg.interval->low, 0.0);
  EXPECT_TRUE(is_significant_by_scene(all.translation_m.test));
  // A motion of all that one variant found changes nothing: there is no truth to tell.
  auto elsewhere = records;
  for (TrialRecord& record : elsewhere) {
    if (record.id.variant == "other") record.T_reference_sensor->translation.x() += 5.0;
  }
  EXPECT_NEAR(compared(elsewhere).back().translation_m.difference, all.translation_m.difference,
              1e-9);
}

TEST(Comparison, FindsAnEffectAndKeepsItsLevel) {
  Rng rng = test_rng();
  int found = 0, wrong = 0, wrong_by_scene = 0;
  constexpr int kRuns = 50;
  for (int i = 0; i < kRuns; ++i) {
    const auto any = [](const std::vector<Comparison>& comparisons,
                        bool (*holds)(const PairedTest&)) {
      const Comparison& all = comparisons.back();
      return holds(all.rotation_deg.test) || holds(all.translation_m.test) || holds(all.success);
    };
    const auto null = compared(random_records(rng, {10, 2, 1.0, 0.2, true}));
    wrong += any(null, is_significant);
    wrong_by_scene += any(null, [](const PairedTest& test) { return test.p_by_scene_holm < 0.05; });
    found += any(compared(random_records(rng, {10, 2, 2.5, 0.0, true})), is_significant_by_scene);
  }
  // 5 % and three standard deviations (3.1 %) of a share of 50: the tests by themselves keep their
  // level in thousands of experiments, see sign_flip_test.cpp and signed_rank_test.cpp.
  EXPECT_LE(wrong, kRuns * 0.143);
  EXPECT_LE(wrong_by_scene, kRuns * 0.143);
  EXPECT_GE(found, kRuns * 0.9);
}

TEST(Comparison, AVariantMoreMakesTheOthersNoMoreSignificant) {
  Rng rng = test_rng();
  auto records = random_records(rng, {12, 4, 1.5, 0.2, true});
  const auto alone = compared(records);
  auto more = random_records(rng, {12, 4, 1.0, 0.2, true});
  for (TrialRecord& record : more) {
    if (record.id.variant != "other") continue;
    record.id.variant = "third";
    records.push_back(record);
  }
  const auto both = compared(records, {"base", "other", "third"});
  ASSERT_EQ(both.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(both[i].variant, "other");
    EXPECT_EQ(both[i].rotation_deg.test.p, alone[i].rotation_deg.test.p);
    EXPECT_GE(both[i].rotation_deg.test.p_holm, alone[i].rotation_deg.test.p_holm);
  }
}

TEST(Comparison, IsInCsvWithEveryColumn) {
  const std::string csv =
      csv_of(comparison_columns(), summarise(test::few_records(), kBounds, {}).comparisons);
  EXPECT_EQ(csv.rfind("variant,base,sensor,pairs,scenes,only_base,only_variant,"
                      "rotation_base_median_deg,rotation_variant_median_deg,",
                      0),
            0U);
  EXPECT_NE(csv.find("\nno volume,base,all,14,2,0,0,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const auto header_end = csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n'));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 4 * std::count(csv.begin(), header_end, ','));
}

TEST(Comparison, IsInJson) {
  auto records = test::few_records();
  for (TrialRecord& record : records) {
    if (record.id.variant == "no volume") record = test::unfinished(record.id, Status::failed, "x");
  }
  const auto json = nlohmann::json::parse(summary_json(summarise(records, kBounds, {})));
  ASSERT_EQ(json["comparisons"].size(), 3U);
  const auto& all = json["comparisons"][2];
  EXPECT_TRUE(all["sensor"].is_null());
  EXPECT_EQ(all["variant"], "no volume");
  EXPECT_EQ(all["pairs"], 14);
  EXPECT_EQ(all["rotation_deg"]["variant_median"], "inf");
  EXPECT_TRUE(all["rotation_deg"]["base_median"].is_number());
  EXPECT_EQ(all["mcnemar"]["is_significant"], true);
  EXPECT_EQ(all["mcnemar"]["holds_by_scene"], false);
}

}  // namespace
}  // namespace croon::experiments
