#include "experiments/report/experiment_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/report/trial_views.hpp"
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

std::vector<TrialView> views_of(const Results& results) {
  return trial_views(results, "", test::fake_catalogue());
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
