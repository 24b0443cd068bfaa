#include "experiments/report/experiment_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/report/named_trials.hpp"
#include "experiments/report/trial_views.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "framework/document/renderers.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/experiments/support/report_parts.hpp"
#include "test/experiments/support/run_bench.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using test::agreeing;
using test::Bench;
using test::expect_sound_page;
using test::section_ids;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

Results results_of(const json& experiment) {
  const Bench bench(experiment);
  bench.run(bench.options("out"));
  Results results = read_results(bench.folder().path() / "out", Content::trials_and_steps);
  results.times = {{"base", "drift", 0.2}, {"base", "behave", 0.5}, {"far", "drift", 0.3}};
  return results;
}

std::vector<TrialView> views_of(const Results& results,
                                const std::vector<std::string>& names = {}) {
  return trial_views(results, names, "", test::fake_catalogue());
}

Document report_of(const Results& results) {
  return experiment_report(results, views_of(results), "");
}

json claiming() {
  json experiment = agreeing();
  experiment["claims"] = json::parse(
      R"([{"claim": "yaw", "source": "paper, Table 1", "variant": "base", "sensor": "s0",
           "measure": "yaw", "statistic": "std", "value": 0.08, "band": [0, 0.08], "why": "x"}])");
  experiment["quoted"] = json::parse(
      R"([{"method": "board", "source": "paper, Table 2", "statistic": "mean", "pitch_deg": 1,
           "roll_deg": 2, "yaw_deg": 3, "x_m": 4, "y_m": 5, "z_m": -6e-5}])");
  return experiment;
}

json sweeping() {
  json experiment = agreeing();
  experiment["starts"] = json::parse(
      R"({"around": "truth", "sweep": {"translation_m": [0, 0.5], "levels": 5}, "trials": 2})");
  return experiment;
}

TEST(ExperimentReport, IsSoundForEveryKindOfExperiment) {
  json by_kind = agreeing(), without_truth = agreeing();
  by_kind["dataset"].update({{"kinds", true}, {"scenes", 4}});
  without_truth["dataset"]["truth"] = false;
  without_truth["starts"]["around"] = "nominal";
  for (const json& experiment :
       {test::drifting(), agreeing(), by_kind, without_truth, claiming(), sweeping()}) {
    SCOPED_TRACE(experiment.dump());
    const Results results = results_of(experiment);
    const Document report = report_of(results);
    expect_sound_page(report);
    EXPECT_THAT(section_ids(report), IsSupersetOf({"result", "pipeline", "charts", "trials",
                                                   "trial-1", "steps", "provenance"}));
    EXPECT_THAT(report.lead, HasSubstr("Best of 2 variants: "));
  }
}

TEST(ExperimentReport, SaysThatThereAreNoTrials) {
  Results results = results_of(agreeing());
  results.records.clear();
  results.summary = {};
  results.acceptance = {};
  results.coverage = {};
  results.diagnostics.clear();
  results.times.clear();
  const Document report = experiment_report(results, views_of(results), "No trial has a pose.");
  EXPECT_EQ(report.lead, "There are no trials.");
  const std::string page = expect_sound_page(report);
  if (!can_write_html()) GTEST_SKIP() << "a build without reports";
  EXPECT_THAT(page, HasSubstr("0 of 48 planned trials are stored."));
  EXPECT_THAT(page, HasSubstr("No trial has a pose."));
  EXPECT_THAT(page, Not(HasSubstr("--trial"))) << "there is none to name";
}

TEST(ExperimentReport, EscapesHostileNames) {
  for (const std::string hostile :
       {"\"><script>alert(1)</script>", "</script><!--<script>", "' onload='alert(1)"}) {
    Results results = results_of(claiming());
    std::vector<TrialView> views = views_of(results);
    // A crafted store may have names that no experiment has.
    json manifest = json::parse(results.manifest);
    json& variant = manifest["experiment"]["variants"][0];
    variant["name"] = variant["pipeline"][0]["name"] = hostile;
    results.manifest = manifest.dump();
    results.name = results.description = results.claims[0].claim.claim = hostile;
    for (TrialRecord& record : results.records) {
      record.id.variant = record.id.scene = record.id.sensor = record.reason = hostile;
    }
    results.summary = summarise(results.records, results.summary.bounds, {});
    ASSERT_FALSE(views.empty());
    for (TrialView& trial : views) {
      trial.why = trial.view.scene = trial.view.sensors[1].sensor = hostile;
      trial.view.close_ups = {{hostile}};
    }
    const std::string page = expect_sound_page(experiment_report(results, views, hostile));
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, Not(HasSubstr("</script><!--")));
  }
}

TEST(TrialViews, AreTheWorstATypicalARejectedAndAFailedTrial) {
  Results results = results_of(agreeing());
  results.records[0].status = Status::rejected;
  results.records[1].status = Status::failed;
  const std::vector<TrialView> views = views_of(results);
  ASSERT_EQ(views.size(), 4U);
  EXPECT_EQ(views[0].why, "The largest error of an accepted pose");
  double largest_m = 0.0;
  for (const TrialRecord& record : results.records) {
    const bool is_accepted = record.status != Status::rejected && record.status != Status::failed;
    if (is_accepted) largest_m = std::max(largest_m, record.error->translation_m);
  }
  EXPECT_EQ(views[0].record->error->translation_m, largest_m);
  EXPECT_EQ(views[2].why, "A rejected pose");
  EXPECT_EQ(views[2].record, &results.records[0]);
  EXPECT_EQ(views[3].record, &results.records[1]);
  for (const TrialView& trial : views) {
    EXPECT_EQ(trial.view.scene, trial.record->id.scene);
    EXPECT_EQ(trial.view.states,
              (std::vector<std::string>{"initial guess", "ground truth", "result"}));
    ASSERT_EQ(trial.view.sensors.size(), 2U);
    const ViewedSensor& sensor = trial.view.sensors[1];
    EXPECT_EQ(sensor.sensor, trial.record->id.sensor);
    EXPECT_EQ(sensor.is_accepted, &trial == &views[0] || &trial == &views[1]);
    const RigidTransform T = trial.view.level.T_level_reference * *trial.record->T_reference_sensor;
    EXPECT_EQ(sensor.poses.back()->translation, T.translation);
    const RigidTransform truth = trial.view.level.T_level_reference.inverse() * *sensor.poses[1];
    EXPECT_NEAR(pose_error(*trial.record->T_reference_sensor, truth).translation_m,
                trial.record->error->translation_m, 1e-9);
  }
}

TEST(TrialViews, WithoutAPoseThereAreNone) {
  Results results = results_of(agreeing());
  for (TrialRecord& record : results.records) record.T_reference_sensor.reset();
  EXPECT_TRUE(views_of(results).empty());
}

TEST(TrialViews, BeginWithTheTrialsThatTheReaderNames) {
  const Results results = results_of(agreeing());
  const std::vector<TrialView> chosen = views_of(results);
  const TrialRecord& largest = *chosen.front().record;
  const auto other = std::find_if(
      results.records.rbegin(), results.records.rend(), [&](const TrialRecord& record) {
        return std::none_of(chosen.begin(), chosen.end(),
                            [&](const TrialView& trial) { return trial.record == &record; });
      });
  const std::string name = trial_name(other->id), name_of_largest = trial_name(largest.id);
  const std::vector<TrialView> views = views_of(results, {name, name_of_largest, name});
  ASSERT_EQ(views.size(), chosen.size() + 1);
  EXPECT_EQ(views[0].record, &*other);
  EXPECT_EQ(views[0].why, "The trial " + name);
  EXPECT_EQ(views[1].record, &largest);
  EXPECT_EQ(views[1].why,
            "The trial " + name_of_largest + ". The largest error of an accepted pose");
  EXPECT_EQ(views[2].record, chosen[1].record);
  expect_sound_page(experiment_report(results, views, ""));
}

TEST(TrialViews, OfATrialWithoutAPoseAreItsInitialGuessAndGroundTruth) {
  for (const bool has_truth : {true, false}) {
    json experiment = agreeing();
    experiment["dataset"]["truth"] = has_truth;
    if (!has_truth) experiment["starts"]["around"] = "nominal";
    Results results = results_of(experiment);
    TrialRecord& failed = results.records[3];
    failed.status = Status::failed;
    failed.T_reference_sensor.reset();
    failed.error.reset();
    const std::vector<TrialView> views = views_of(results, {trial_name(failed.id)});
    ASSERT_FALSE(views.empty());
    EXPECT_EQ(views[0].record, &failed);
    std::vector<std::string> states = {"initial guess"};
    if (has_truth) states.emplace_back("ground truth");
    EXPECT_EQ(views[0].view.states, states);
    EXPECT_FALSE(views[0].view.sensors[1].is_accepted);
    EXPECT_TRUE(views[0].charts.empty());
    EXPECT_FALSE(views[1].charts.empty());
    expect_sound_page(experiment_report(results, views, ""));
  }
}

TEST(TrialViews, OfASensorCalibratedToAnotherOne) {
  json experiment = agreeing();
  experiment["loops"] = true;
  const Results results = results_of(experiment);
  const auto pair =
      std::find_if(results.records.begin(), results.records.end(), [](const TrialRecord& record) {
        return record.id.sensor.find(kBetweenSensors) != std::string::npos;
      });
  ASSERT_NE(pair, results.records.end());
  const std::vector<TrialView> views = views_of(results, {trial_name(pair->id)});
  ASSERT_FALSE(views.empty());
  EXPECT_EQ(views[0].record, &*pair);
  EXPECT_EQ(views[0].view.sensors[0].sensor + " " + views[0].view.sensors[1].sensor, "s1 s0");
}

/// Records of the trials 0 to 3 of two scenes, one of which has a slash in its name.
std::vector<TrialRecord> records_of(const std::vector<std::string>& variants) {
  std::vector<TrialRecord> records;
  for (const std::string& variant : variants) {
    for (const char* scene : {"drive", "drive/2"}) {
      for (int trial = 0; trial < 4; ++trial) {
        records.push_back({{variant, scene, "left", trial}, Status::failed, "", {}, {}, {}, {}});
      }
    }
  }
  return records;
}

TEST(TrialsCalled, NeedNoVariantIfThereIsOne) {
  const std::vector<TrialRecord> one = records_of({"leaf/0.1"});
  const auto found = trials_called({"drive/2/left/3", "leaf/0.1/drive/left/1"}, one);
  EXPECT_EQ(found, (std::vector<const TrialRecord*>{&one[7], &one[1]}));
  const std::vector<TrialRecord> two = records_of({"base", "base/drive"});
  EXPECT_EQ(trials_called({"base/drive/drive/2/left/0"}, two).front(), &two[12]);
  EXPECT_NE(test::input_error([&] { trials_called({"drive/2/left/3"}, two); }), "");
}

TEST(TrialsCalled, RefusesNamesThatNoTrialHas) {
  const std::vector<TrialRecord> records = records_of({"base", "far"});
  const std::string expected =
      "--trial: expected the name of a stored trial, VARIANT/SCENE/SENSOR/NUMBER, found ";
  const auto error = [&](const std::string& name) {
    return test::input_error([&] { trials_called({name}, records); });
  };
  EXPECT_EQ(error("base/drive/left/9"),
            expected + "\"base/drive/left/9\"; did you mean \"base/drive/left/3\"?");
  EXPECT_EQ(error("bsae/drive/lfet/2"),
            expected + "\"bsae/drive/lfet/2\"; did you mean \"base/drive/left/2\"?");
  EXPECT_THAT(error("7"), HasSubstr("\"7\"; known: base/drive/left/3, base/drive/2/left/3"));
  EXPECT_EQ(test::input_error([&] { trials_called({"a"}, {}); }), expected + "\"a\"");
  // Both faults of two names.
  EXPECT_THAT(test::input_error([&] {
                trials_called({"x/9", "y/9"}, records);
              }),
              AllOf(HasSubstr("\"x/9\""), HasSubstr("\"y/9\"")));
}

TEST(PipelineChart, MarksStepsThatDifferFromTheFirstVariant) {
  const std::string manifest = results_of(agreeing()).manifest;
  for (const Sheet& sheet : {Sheet(), kOneColumn, kTwoColumns}) {
    const Drawing drawing = pipeline_chart(manifest, sheet);
    EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
    std::vector<std::string> texts;
    for (const Drawing::Element& element : drawing.elements()) {
      if (const auto* text = std::get_if<Drawing::Text>(&element)) texts.push_back(text->text);
    }
    EXPECT_EQ(texts,
              (std::vector<std::string>{"base", "far", "drift", "behave", "* drift", "behave"}));
  }
}

TEST(PipelineChart, ShowsTheFirstOfManyVariants) {
  json manifest = json::parse(results_of(agreeing()).manifest);
  json& variants = manifest["experiment"]["variants"];
  for (int i = 0; i < 30; ++i) variants.push_back(variants[0]);
  for (int i = 0; i < 30; ++i) variants[0]["pipeline"].push_back(variants[0]["pipeline"][0]);
  for (const Sheet& sheet : {Sheet(), kOneColumn}) {
    const Drawing drawing = pipeline_chart(manifest.dump(), sheet);
    EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
    const auto& last = std::get<Drawing::Text>(drawing.elements().back());
    EXPECT_THAT(last.text, HasSubstr("and further variants"));
  }
}

}  // namespace
}  // namespace croon::experiments
