#include "experiments/analysis/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/document/renderers.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::test_rng;
using test::kBounds;

const std::vector<std::string> kSensors = {"left", "rear", "right"};

/// Trials of two variants with truth, of which some fail and some sensors miss some scenes.
std::vector<TrialRecord> random_records(Rng& rng) {
  std::vector<TrialRecord> records;
  for (const char* variant : {"base", "other"}) {
    for (int scene = 0; scene < 6; ++scene) {
      for (const std::string& sensor : kSensors) {
        if (rng.uniform() < 0.1) continue;
        const RigidTransform truth = croon::test::random_pose(rng, 2.0);
        const Vector6d bias = test::random_offset(rng, 0.1, 0.02);
        for (int trial = 0; trial < 4; ++trial) {
          const TrialId id = {variant, "s" + std::to_string(scene), sensor, trial};
          const Vector6d offset = bias + test::random_offset(rng, 0.1, 0.02);
          const double draw = rng.uniform();
          if (draw < 0.05) {
            records.push_back(test::unfinished(id, Status::failed, "no ground"));
          } else {
            records.push_back(test::finished(id, draw < 0.1 ? Status::inaccurate : Status::success,
                                             truth, offset));
          }
        }
      }
    }
  }
  return records;
}

Summary summary_of(const std::vector<TrialRecord>& records) {
  return summarise(records, kBounds, {{"base", "other"}, kSensors, {}, {}});
}

bool is_of(const TrialRecord& record, const std::string& variant, const std::string& sensor) {
  return record.id.variant == variant && (sensor.empty() || record.id.sensor == sensor);
}

/// The errors of measure `k` of successful trials, by sensor and scene.
using Groups = std::map<std::string, std::map<std::string, std::vector<double>>>;

Groups errors_of(const std::vector<TrialRecord>& records, const std::string& variant,
                 const std::string& sensor, std::size_t k) {
  Groups groups;
  for (const TrialRecord& record : records) {
    if (record.status != Status::success || !is_of(record, variant, sensor)) continue;
    groups[record.id.sensor][record.id.scene].push_back(measures_of(*record.error)[k]);
  }
  return groups;
}

std::vector<double> all_of(const Groups& groups) {
  std::vector<double> values;
  for (const auto& [sensor, scenes] : groups) {
    for (const auto& [scene, errors] : scenes) {
      values.insert(values.end(), errors.begin(), errors.end());
    }
  }
  return values;
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value - mean(values), 2);
  return sum;
}

/// The spread inside scenes about their means, and that of the means, over all sensors.
std::pair<double, double> spreads_of(const Groups& groups) {
  double within = 0.0, trials = 0.0, across = 0.0, scenes_left = 0.0;
  for (const auto& [sensor, scenes] : groups) {
    std::vector<double> means;
    for (const auto& [scene, errors] : scenes) {
      within += sum_of_squares(errors);
      trials += static_cast<double>(errors.size()) - 1.0;
      means.push_back(mean(errors));
    }
    across += sum_of_squares(means);
    scenes_left += static_cast<double>(means.size()) - 1.0;
  }
  return {std::sqrt(within / trials), std::sqrt(across / scenes_left)};
}

/// Percent of trials and percent of scenes that succeed.
std::pair<double, double> shares_of(const std::vector<TrialRecord>& records,
                                    const std::string& variant, const std::string& sensor) {
  std::map<std::string, bool> scenes;
  double trials = 0.0, successes = 0.0;
  for (const TrialRecord& record : records) {
    if (!is_of(record, variant, sensor)) continue;
    const bool succeeds = record.status == Status::success;
    trials += 1.0;
    successes += succeeds ? 1.0 : 0.0;
    scenes[record.id.scene] = scenes.emplace(record.id.scene, true).first->second && succeeds;
  }
  double good = 0.0;
  for (const auto& [scene, is_good] : scenes) good += is_good ? 1.0 : 0.0;
  return {100.0 * successes / trials, 100.0 * good / static_cast<double>(scenes.size())};
}

Claim expectation(const std::string& statistic, const std::string& measure = "",
                  const std::string& sensor = "", const std::string& variant = "base") {
  Claim one;
  one.claim = "a claim";
  one.source = "a source";
  one.variant = variant;
  one.sensor = sensor;
  one.measure = measure;
  one.statistic = statistic;
  one.value = 0.0;
  one.band = {-1000.0, 1000.0};
  return one;
}

double found(const Summary& summary, const Claim& one) {
  const ClaimResult result = check_claims({one}, summary).front();
  EXPECT_NE(result.outcome, ClaimOutcome::not_measured);
  EXPECT_NE(result.outcome, ClaimOutcome::out);
  return result.found.value_or(std::nan(""));
}

TEST(Claims, StatisticsAreThoseOfTheTrials) {
  Rng rng = test_rng();
  for (int i = 0; i < 10; ++i) {
    const std::vector<TrialRecord> records = random_records(rng);
    const Summary summary = summary_of(records);
    for (const std::string& sensor : {std::string(), kSensors[0], kSensors[2]}) {
      for (std::size_t k = 0; k < kMeasures.size(); ++k) {
        const auto one = [&](const char* statistic) {
          return found(summary, expectation(statistic, kMeasures[k].name, sensor, "other"));
        };
        const Groups groups = errors_of(records, "other", sensor, k);
        const std::vector<double> errors = all_of(groups);
        std::vector<double> magnitudes;
        for (const double error : errors) magnitudes.push_back(std::abs(error));
        EXPECT_NEAR(one("mean"), mean(errors), 1e-12);
        EXPECT_NEAR(one("std"), standard_deviation(errors), 1e-12);
        EXPECT_NEAR(one("median"), median(errors), 1e-12);
        EXPECT_NEAR(one("rmse"), root_mean_square(errors), 1e-12);
        EXPECT_NEAR(one("p95"), percentile(magnitudes, 0.95), 1e-12);
        if (k >= kDofs) continue;
        const auto [within, across] = spreads_of(groups);
        // Inside scenes, from the consensus and not from the mean: the same to the second order.
        EXPECT_NEAR(one("within_scene_std"), within, 0.01 * within);
        EXPECT_NEAR(one("across_scenes_std"), across, 1e-9);
      }
    }
  }
}

TEST(Claims, SharesAreThoseOfTrialsAndScenes) {
  Rng rng = test_rng(2);
  for (int i = 0; i < 20; ++i) {
    const std::vector<TrialRecord> records = random_records(rng);
    const Summary summary = summary_of(records);
    for (const std::string& sensor : {std::string(), kSensors[1]}) {
      const auto [trials, scenes] = shares_of(records, "base", sensor);
      EXPECT_NEAR(found(summary, expectation("success", "", sensor)), trials, 1e-9);
      EXPECT_NEAR(found(summary, expectation("scenes", "", sensor)), scenes, 1e-9);
    }
  }
}

TEST(Claims, TheSpreadOfAPoseIsThatOfItsDofsTogether) {
  Rng rng = test_rng(3);
  const Summary summary = summary_of(random_records(rng));
  for (const char* statistic : {"within_scene_std", "across_scenes_std"}) {
    const auto of = [&](const char* measure) {
      return found(summary, expectation(statistic, measure));
    };
    EXPECT_NEAR(of("rotation"), std::hypot(of("roll"), of("pitch"), of("yaw")), 1e-12);
    EXPECT_NEAR(of("translation"), std::hypot(of("x"), of("y"), of("z")), 1e-12);
  }
}

TEST(Claims, WithoutTruthThereIsAgreementAndNoSuccess) {
  Rng rng = test_rng(4);
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 10; ++trial) {
    const Vector6d offset =
        trial == 9 ? test::offset_of(0, 0, 40, 0, 0, 0) : test::random_offset(rng, 0.01, 0.001);
    records.push_back(
        test::finished_without_truth({"base", "s", "left", trial}, moved({}, offset)));
  }
  const Summary summary = summary_of(records);
  EXPECT_EQ(found(summary, expectation("agreement")), 90.0);
  for (const char* statistic : {"success", "scenes"}) {
    const ClaimResult result = check_claims({expectation(statistic)}, summary).front();
    EXPECT_EQ(result.outcome, ClaimOutcome::not_measured) << statistic;
  }
  EXPECT_LT(found(summary, expectation("within_scene_std", "rotation")), 0.02);
}

TEST(Claims, BandsAreClosed) {
  Rng rng = test_rng(5);
  const Summary summary = summary_of(random_records(rng));
  Claim one = expectation("std", "yaw");
  EXPECT_EQ(check_claims({one}, summary).front().outcome, ClaimOutcome::shown);
  const double value = found(summary, one);
  const auto outcome = [&](double low, double high) {
    one.band = {low, high};
    return check_claims({one}, summary).front().outcome;
  };
  EXPECT_EQ(outcome(value, value), ClaimOutcome::in);
  EXPECT_EQ(outcome(std::nextafter(value, 1.0), 1.0), ClaimOutcome::out);
  EXPECT_EQ(outcome(0.0, std::nextafter(value, 0.0)), ClaimOutcome::out);
}

TEST(Claims, WhatTheRunLacksIsNotMeasured) {
  const auto is_missing = [](const Summary& summary, const Claim& one) {
    const ClaimResult result = check_claims({one}, summary).front();
    return result.outcome == ClaimOutcome::not_measured && !result.found;
  };
  const Summary summary = summary_of(test::few_records());
  for (const char* statistic : {"success", "scenes", "mean", "within_scene_std"}) {
    const std::string measure = is_share(statistic) ? "" : "yaw";
    EXPECT_TRUE(is_missing(summary, expectation(statistic, measure, "front")));
    EXPECT_TRUE(is_missing(summary, expectation(statistic, measure, "", "none")));
    EXPECT_TRUE(is_missing({}, expectation(statistic, measure)));
    EXPECT_FALSE(is_missing(summary, expectation(statistic, measure)));
  }
  const Summary failed =
      summary_of({test::unfinished({"base", "s", "left", 0}, Status::failed, "x")});
  EXPECT_TRUE(is_missing(failed, expectation("mean", "yaw")));
  EXPECT_TRUE(is_missing(failed, expectation("across_scenes_std", "yaw")));
  EXPECT_EQ(found(failed, expectation("success")), 0.0);
}

/// `trials` trials of each of `scenes` scenes, the last of each 0.3 m off, the others up to 4 cm.
Summary mostly_good(int scenes, int trials) {
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < scenes; ++scene) {
    for (int trial = 0; trial < trials; ++trial) {
      const bool is_good = trial + 1 < trials;
      const double x_m = is_good ? 0.01 * (trial % 5) : 0.3;
      records.push_back(test::finished({"base", std::to_string(scene), "left", trial},
                                       is_good ? Status::success : Status::inaccurate, {},
                                       test::offset_of(0, 0, 0, x_m, 0, 0)));
    }
  }
  return summary_of(records);
}

/// Two trials of each of eight scenes, 0.0999 m off along x to either side, or to one per scene.
Summary at_the_bounds(bool differs_by_scene) {
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < 8; ++scene) {
    for (int trial = 0; trial < 2; ++trial) {
      const double side = (differs_by_scene ? scene : trial) % 2 == 0 ? 1.0 : -1.0;
      records.push_back(test::finished({"base", std::to_string(scene), "left", trial},
                                       Status::success, {},
                                       test::offset_of(0, 0, 0, 0.0999 * side, 0, 0)));
    }
  }
  return summary_of(records);
}

TEST(Claims, ASpreadCanBeAsLargeAsItsGroupsAllow) {
  const auto result = [](const char* statistic, bool differs_by_scene, double high) {
    Claim one = expectation(statistic, "x");
    one.band = {0.0, high};
    return check_claims({one}, at_the_bounds(differs_by_scene)).front();
  };
  // Two values per scene: 0.1 m times sqrt(2); eight scenes: times sqrt(8 / 7).
  EXPECT_NEAR(*result("within_scene_std", false, 1.0).found, 0.0999 * std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(result("within_scene_std", false, 0.11).can_fail);
  EXPECT_TRUE(result("within_scene_std", false, 0.1414).can_fail);
  EXPECT_FALSE(result("within_scene_std", false, 0.1415).can_fail);
  EXPECT_NEAR(*result("across_scenes_std", true, 1.0).found, 0.0999 * std::sqrt(8.0 / 7.0), 1e-9);
  EXPECT_TRUE(result("across_scenes_std", true, 0.1065).can_fail);
  EXPECT_FALSE(result("across_scenes_std", true, 0.107).can_fail);
}

TEST(Claims, ADistanceIsNotNegative) {
  const auto can_fail = [](const char* statistic, const char* measure, double low, double high) {
    Claim one = expectation(statistic, measure);
    one.band = {low, high};
    return check_claims({one}, mostly_good(8, 10)).front().can_fail;
  };
  EXPECT_FALSE(can_fail("median", "translation", 0.0, 0.1));
  EXPECT_FALSE(can_fail("mean", "rotation", 0.0, 0.5));
  EXPECT_TRUE(can_fail("median", "x", 0.0, 0.1));
  // Of 72 values from 0 to 0.1 m the std is at most 0.05 m times sqrt(72 / 71).
  EXPECT_FALSE(can_fail("std", "translation", 0.0, 0.0504));
  EXPECT_TRUE(can_fail("std", "translation", 0.0, 0.0503));
}

TEST(Claims, ABandThatNoResultCanMissIsNoVerdict) {
  const Summary summary = mostly_good(8, 10);
  Claim one = expectation("std", "x");
  const auto result = [&](double high) {
    one.band = {0.0, high};
    return check_claims({one}, summary).front();
  };
  // Successful trials are within 0.1 m, so their std is at most 0.1 m times sqrt(72 / 71).
  EXPECT_EQ(result(0.107).outcome, ClaimOutcome::shown);
  EXPECT_FALSE(result(0.107).can_fail);
  EXPECT_EQ(result(0.09).outcome, ClaimOutcome::in);
  EXPECT_EQ(result(0.01).outcome, ClaimOutcome::out);
  EXPECT_EQ(result(0.09).trials, 72);
  EXPECT_EQ(result(0.09).scenes, 8);
  EXPECT_EQ(result(0.09).success_percent, 90.0);
  one.over = Over::usable;
  EXPECT_TRUE(result(0.107).can_fail);
  EXPECT_EQ(result(0.107).trials, 80);
  EXPECT_EQ(result(0.107).outcome, ClaimOutcome::in);
  EXPECT_EQ(result(0.08).outcome, ClaimOutcome::out);  // 0.3 m in a tenth of the trials: 0.086 m.
}

TEST(Claims, OfFewTrialsOrScenesIsNoVerdict) {
  const auto outcome = [](const char* statistic, int scenes, int trials) {
    Claim one = expectation(statistic, is_share(statistic) ? "" : "x");
    one.band = {0.0, is_share(statistic) ? 99.0 : 0.09};
    return check_claims({one}, mostly_good(scenes, trials)).front().outcome;
  };
  for (const char* statistic : {"std", "success", "scenes", "across_scenes_std"}) {
    EXPECT_EQ(outcome(statistic, 2, 3), ClaimOutcome::not_enough) << statistic;
    EXPECT_EQ(outcome(statistic, 5, 10), ClaimOutcome::not_enough) << statistic;
    EXPECT_EQ(outcome(statistic, 6, 2), ClaimOutcome::not_enough) << statistic;
    EXPECT_EQ(outcome(statistic, 6, 10), ClaimOutcome::in) << statistic;
  }
  EXPECT_EQ(outcome("within_scene_std", 60, 1), ClaimOutcome::not_measured);
  EXPECT_EQ(outcome("within_scene_std", 2, 10), ClaimOutcome::not_enough);
  EXPECT_EQ(outcome("within_scene_std", 2, 40), ClaimOutcome::in);
}

Quoted board() {
  Quoted row;
  row.method = "a | board";
  row.source = "paper, Table 2";
  row.statistic = "mean";
  row.roll_deg = -1.0449;
  row.pitch_deg = -0.0264;
  row.yaw_deg = -0.3068;
  row.x_m = 0.0094;
  row.y_m = -0.0098;
  row.z_m = 0.0314;
  return row;
}

TEST(Claims, OurRowIsThatOfAllSensorsOfTheFirstVariant) {
  Rng rng = test_rng(6);
  const Summary summary = summary_of(random_records(rng));
  for (const char* statistic : {"mean", "std", "median", "rmse", "p95"}) {
    Quoted row = board();
    row.statistic = statistic;
    const auto ours = row_beside(row, summary);
    ASSERT_TRUE(ours);
    for (std::size_t k = 0; k < kDofs; ++k) {
      EXPECT_EQ((*ours)[k], found(summary, expectation(statistic, kMeasures[k].name)));
    }
  }
  EXPECT_FALSE(row_beside(board(), {}));
}

ClaimResult result_of(const Claim& claim, std::optional<double> found, ClaimOutcome outcome) {
  ClaimResult result;
  result.claim = claim;
  result.found = found;
  result.outcome = outcome;
  return result;
}

/// One claim of each verdict.
std::vector<ClaimResult> one_of_each() {
  std::vector<ClaimResult> results(3, result_of(expectation("std", "yaw"), 0.25, ClaimOutcome::in));
  results[1].claim.claim = "yaw | of the front";
  results[1].claim.why = "scenes of our own";
  results[1].outcome = ClaimOutcome::out;
  results[2] = result_of(expectation("success"), std::nullopt, ClaimOutcome::not_measured);
  results[2].claim.why = "scenes of our own";
  return results;
}

Results with_claims_and_quoted() {
  Results results;
  results.summary = summary_of(test::few_records());
  results.claims = one_of_each();
  results.quoted = {board()};
  return results;
}

TEST(Claims, TheTableHasALineForEachAndEachReasonOnce) {
  const Section section = claims_section(with_claims_and_quoted());
  const std::string text = text_section(section);
  EXPECT_EQ(text.find("warning: 1 in, 1 out, 1 not measured\n"), 0U) << text;
  EXPECT_THAT(text, testing::HasSubstr("0 deg  [-1000, 1000]  0.25000            in    -\n"));
  EXPECT_THAT(text, testing::HasSubstr("0 %  [-1000, 1000]        -  not measured    1\n"));
  EXPECT_THAT(text, testing::HasSubstr("fewer than 30 trials or 6 scenes"));
  EXPECT_THAT(text, testing::HasSubstr("\n1: scenes of our own\n"));
  EXPECT_EQ(text.find("2: scenes"), std::string::npos) << text;
  const std::string markdown = markdown_section(section);
  EXPECT_THAT(markdown,
              testing::HasSubstr("| yaw \\| of the front | a source | 0 | 0 | - | 0 deg | "
                                 "[-1000, 1000] | 0.25000 | out | 1 |\n"));
}

TEST(Claims, QuotedRowsAreFollowedByOurs) {
  Results results = with_claims_and_quoted();
  const std::string text = text_section(quoted_section(results));
  const std::size_t quoted = text.find("a | board");
  EXPECT_NE(text.find("mean        -0.02640  -1.04490  -0.30680", quoted), std::string::npos)
      << text;
  EXPECT_NE(text.find("ours, all sensors", quoted), std::string::npos) << text;
  results.summary = {};
  EXPECT_THAT(markdown_section(quoted_section(results)),
              testing::HasSubstr("| - | - | - | - | - | - |\n"));
}

TEST(Claims, ThePageSaysSoIfThereAreNone) {
  Results results = with_claims_and_quoted();
  EXPECT_THAT(markdown_section(claims_page(results)),
              testing::Not(testing::HasSubstr("no claims")));
  results.claims.clear();
  results.quoted.clear();
  EXPECT_THAT(markdown_section(claims_page(results)), testing::HasSubstr("makes no claims."));
}

TEST(Claims, StandInSummaryJson) {
  const Summary summary = summary_of(test::few_records());
  EXPECT_FALSE(nlohmann::json::parse(summary_json(summary)).contains("claims"));
  const auto claims = nlohmann::json::parse(summary_json(summary, one_of_each()))["claims"];
  ASSERT_EQ(claims.size(), 3U);
  EXPECT_EQ(claims[0]["found"], 0.25);
  EXPECT_EQ(claims[0]["unit"], "deg");
  EXPECT_EQ(claims[1]["verdict"], "out");
  EXPECT_EQ(claims[2]["unit"], "%");
}

}  // namespace
}  // namespace croon::experiments
