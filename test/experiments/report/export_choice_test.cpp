#include "experiments/report/export_choice.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/report/figures.hpp"
#include "framework/base/error.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;
using Names = std::vector<std::string>;

const ExportCaption kCaption = {"few", "0123456789ab", 7, 2, 4, 29, 32};

ExportTable chosen(const TableChoice& choice) {
  return export_table(summarise(test::few_records(), kBounds, {}), kCaption, choice);
}

Names columns_of(const ExportTable& table) {
  Names names;
  for (const Column& column : table.table.columns) names.push_back(column.full_name());
  return names;
}

/// The message of the InputError that `work` throws.
template <class F>
std::string refusal(const F& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TableChoice, HasTheColumnsThatAreAskedFor) {
  TableChoice choice;
  choice.columns = {"success", "success_interval", "x", "yaw_p95"};
  const ExportTable table = chosen(choice);
  EXPECT_EQ(
      columns_of(table),
      (Names{"variant", "sensor", "reference", "scenes", "trials", "success_percent",
             "success_low_percent", "success_high_percent", "x_mean_m", "x_std_m", "yaw_p95_deg"}));
  const ExportTable full = export_table(summarise(test::few_records(), kBounds, {}), kCaption);
  ASSERT_EQ(table.table.rows.size(), full.table.rows.size());
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    for (const char* name : {"success_percent", "x_mean_m", "x_std_m"}) {
      EXPECT_EQ(table.table.at(i, name).value, full.table.at(i, name).value);
      EXPECT_EQ(table.table.at(i, name).is_best, full.table.at(i, name).is_best);
    }
  }
  const std::string text = export_markdown(table);
  EXPECT_NE(text.find("| variant | sensor | success (%) rate | success (%) 95 % interval | x (m) "
                      "mean ± std | yaw (deg) p95 |"),
            std::string::npos)
      << text;
}

TEST(TableChoice, HasEveryStatisticOfEveryMeasure) {
  for (const Measure& measure : kMeasures) {
    for (const Statistic& statistic : kStatistics) {
      TableChoice choice;
      choice.columns = {std::string(measure.name) + "_" + statistic.name};
      EXPECT_EQ(columns_of(chosen(choice)).size(), 6U) << choice.columns.front();
    }
  }
}

TEST(TableChoice, HasTheSensorsThatAreAskedFor) {
  const auto sensors_of = [](const Names& sensors) {
    TableChoice choice;
    choice.sensors = sensors;
    const ExportTable table = chosen(choice);
    Names names;
    for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
      names.push_back(table.table.text_at(i, "sensor"));
    }
    return names;
  };
  EXPECT_EQ(sensors_of({"left"}), (Names{"left", "left"}));
  EXPECT_EQ(sensors_of({"all"}), (Names{"", ""}));
  EXPECT_EQ(sensors_of({"all", "right"}), (Names{"right", "right", "", ""}));
}

TEST(TableChoice, RefusesUnknownNamesWithTheNearest) {
  EXPECT_NE(refusal([] {
              chosen({{}, {"sucess"}});
            }).find("did you mean \"success\"?"),
            std::string::npos);
  EXPECT_NE(refusal([] {
              chosen({{"lef"}, {}});
            })
                .find("--sensors: unknown name \"lef\"; did you "
                      "mean \"left\"?"),
            std::string::npos);
}

TEST(TableChoice, MillimetresAreAThousandTimesAsMany) {
  TableChoice choice;
  choice.columns = {"translation_median", "rotation_median"};
  const ExportTable metres = chosen(choice);
  choice.is_in_mm = true;
  const ExportTable table = chosen(choice);
  EXPECT_EQ(columns_of(table)[5], "translation_median_mm");
  EXPECT_EQ(columns_of(table)[6], "rotation_median_deg");
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    EXPECT_EQ(std::get<double>(table.table.rows[i][5].value),
              1000.0 * std::get<double>(metres.table.rows[i][5].value));
  }
  EXPECT_EQ(table.table.columns[5].decimals, 1);
  EXPECT_NE(export_latex(table).find("translation (mm)"), std::string::npos);
  const std::string full = export_markdown(chosen({{}, {}, true}));
  EXPECT_NE(full.find("| x mm |"), std::string::npos);
  EXPECT_EQ(full.find(" m |"), std::string::npos);
}

TEST(TableChoice, TheCaptionNamesTheKindsOfScenes) {
  ExportTable table = chosen({});
  table.caption.kinds = {"urban", "narrow"};
  EXPECT_EQ(caption_sentences(table).at(1).find("2 scenes of urban, narrow, 2 sensors"), 0U);
}

/// The choices of --compact.
TableChoice compact() {
  return {{}, page_columns({summarise(test::few_records(), kBounds, {})}, true), false, true, true};
}

TEST(Compact, IsARowPerVariant) {
  TableChoice choice = compact();
  const ExportTable table = chosen(choice);
  EXPECT_EQ(table.table.rows.size(), 2U);
  const std::string latex = export_latex(table);
  EXPECT_NE(latex.find("\\begin{table}[tbp]"), std::string::npos);
  EXPECT_EQ(latex.find("table*"), std::string::npos);
  choice.columns = {"x", "y", "z", "roll", "pitch", "yaw", "success_interval"};
  EXPECT_NE(
      refusal([&] { export_latex(chosen(choice)); }).find("--columns: these 7 columns need about "),
      std::string::npos);
}

TEST(Compact, SaysOfHowManyScenesAndTrialsARowIs) {
  TableChoice choice = compact();
  const ExportTable table = chosen(choice);
  for (const ExportFormat& format : export_formats()) {
    const std::string text = format.bytes(table);
    if (format.name == std::string("csv")) {
      EXPECT_EQ(text.find("variant,sensor,reference,scenes,trials,success_percent,"), 0U) << text;
      EXPECT_NE(text.find("\nbase,all,truth,2,15,80,"), std::string::npos) << text;
    } else {
      EXPECT_NE(text.find("a row has 14 to 15 of 2 scenes."), std::string::npos) << text;
    }
  }
  // Of the chosen rows, and not of the table.
  choice.sensors = {"left"};
  EXPECT_NE(caption_sentences(chosen(choice)).at(1).find("a row has 8 of 2"), std::string::npos);
  choice.columns = {"scenes", "trials"};
  EXPECT_NE(export_markdown(chosen(choice)).find("| variant | sensor | scenes | trials |"),
            std::string::npos);
}

TEST(Compact, OfExperimentsWithAndWithoutTruthHasSuccessAndAgreement) {
  std::vector<TrialRecord> untrue;
  for (int trial = 0; trial < 3; ++trial) {
    untrue.push_back(test::finished_without_truth({"base", "0001", "left", trial}, {}));
  }
  const std::vector<Summary> summaries = {summarise(test::few_records(), kBounds, {}),
                                          summarise(untrue, kBounds, {})};
  EXPECT_EQ(page_columns(summaries, true),
            (Names{"success", "agreement", "rotation_median", "translation_median"}));
  // Each alone has what it has.
  EXPECT_EQ(page_columns({summaries[0]}, true)[1], "rotation_median");
  EXPECT_EQ(page_columns({summaries[1]}, false),
            (Names{"agreement", "agreement_interval", "rotation_median", "rotation_p95",
                   "translation_median", "translation_p95"}));
  // The only sensor is its own row of all sensors.
  EXPECT_EQ(export_table(summaries[1], kCaption, compact()).table.rows.size(), 1U);
}

TEST(Compact, CaptionsExplainTheColumnsThatAreThere) {
  const std::string compact_table = export_markdown(chosen(compact()));
  const std::string full_table = export_markdown(chosen({}));
  for (const char* explanation : {"Interval: ", "Paired: "}) {
    EXPECT_EQ(compact_table.find(explanation), std::string::npos);
    EXPECT_NE(full_table.find(explanation), std::string::npos);
  }
}

TEST(Joined, GroupsTheRowsByExperiment) {
  TableChoice choice;
  choice.sensors = {"all"};
  std::vector<ExportTable> tables = {chosen(choice), chosen(choice)};
  tables[1].caption.name = "other";
  const ExportTable table = joined(tables, {"a", "b"});
  ASSERT_EQ(table.table.rows.size(), 4U);
  EXPECT_EQ(table.table.text_at(0, "experiment"), "few");
  EXPECT_EQ(table.table.text_at(3, "experiment"), "other");
  EXPECT_EQ(caption_sentences(table).at(0), "few (croon, commit 0123456789ab, seed 7).");
  EXPECT_EQ(caption_sentences(table).at(2), "other (croon, commit 0123456789ab, seed 7).");
  EXPECT_EQ(caption_sentences(table).size(), caption_sentences(tables[0]).size() + 2);
  EXPECT_EQ(export_csv(table).find("experiment,variant,sensor,"), 0U);
  EXPECT_EQ(nlohmann::json::parse(export_json(table))["experiments"][1]["name"], "other");
  for (ExportTable& part : tables) choose(part, compact());
  const std::string latex = export_latex(joined(tables, {"a", "b"}));
  EXPECT_NE(latex.find("{\\itshape few}"), std::string::npos);
  EXPECT_NE(latex.find("{\\itshape other}"), std::string::npos);
  EXPECT_NE(export_markdown(table).find("| experiment | variant | sensor |"), std::string::npos);
}

TEST(Joined, NamesExperimentsOfOneNameByTheirFolders) {
  const ExportTable table = joined({chosen({}), chosen({})}, {"a", "b"});
  EXPECT_EQ(table.table.text_at(0, "experiment"), "few in a");
  EXPECT_EQ(table.table.text_at(table.table.rows.size() - 1, "experiment"), "few in b");
}

TEST(Chosen, MarksNoErrorsWithoutTheirPairedDifference) {
  TableChoice choice;
  choice.columns = {"success", "translation_median"};
  const auto marks = [&] {
    ExportTable table = chosen({});
    for (CellRow& row : table.table.rows) {
      row[table.table.index_of("translation_median_m")].mark = "+*";
    }
    choose(table, choice);
    return table.table.rows[0][table.table.index_of("translation_median_m")].mark;
  };
  EXPECT_EQ(marks(), "");
  choice.columns.emplace_back("translation_paired");
  EXPECT_EQ(marks(), "+*");
}

TEST(Joined, RefusesWhatCannotBeCompared) {
  std::vector<ExportTable> tables = {chosen({}), chosen({})};
  tables[1].caption.name = "other";
  tables[1].bounds.translation_m = 0.2;
  EXPECT_NE(refusal([&] {
              joined(tables, {"a", "b"});
            }).find("b: expected success within 0.5 deg and 0.1 m of ground truth"),
            std::string::npos);
}

TEST(Restricted, HasTheStepsAndClaimsOfTheChosenTrials) {
  Results results;
  results.records = test::few_records();
  results.trials = 4;
  results.scenes = 2;
  results.planned = 32;
  results.summary = summarise(results.records, kBounds, {});
  results.steps.names = {"step", "name"};
  for (std::size_t i = 0; i < results.records.size(); ++i) {
    results.steps.numbers.push_back({static_cast<std::uint32_t>(i), 0, 1, static_cast<double>(i)});
  }
  Claim claim;
  claim.variant = "base";
  claim.statistic = "success";
  results.claims = check_claims({claim}, results.summary);
  const int all_trials = results.claims.front().trials;
  const Results left = restricted(results, {{}, {"left"}, {}});
  ASSERT_EQ(left.steps.numbers.size(), left.records.size());
  for (const StepNumber& number : left.steps.numbers) {
    const TrialId& before = results.records[static_cast<std::size_t>(number.value)].id;
    const TrialId& now = left.records[number.record].id;
    EXPECT_EQ(std::tie(before.variant, before.scene, before.sensor, before.trial),
              std::tie(now.variant, now.scene, now.sensor, now.trial));
  }
  int trials = 0;
  for (const DiagnosticSummary& diagnostic : left.diagnostics) trials += diagnostic.trials;
  EXPECT_EQ(trials, static_cast<int>(left.records.size()));
  const auto of_base = std::count_if(left.records.begin(), left.records.end(),
                                     [](const TrialRecord& r) { return r.id.variant == "base"; });
  EXPECT_EQ(left.claims.front().trials, of_base);
  EXPECT_LT(left.claims.front().trials, all_trials);
}

TEST(Restricted, IsWhatARunWithoutTheOtherTrialsHas) {
  Results results;
  results.records = test::few_records();
  results.trials = 4;
  results.scenes = 2;
  results.planned = 32;
  ReportOrder order;
  order.scene_kinds = {{"0001", "urban"}, {"0002", "highway"}};
  results.summary = summarise(results.records, kBounds, order);
  const Results urban = restricted(results, {{}, {}, {"urban"}});
  for (const TrialRecord& record : urban.records) EXPECT_EQ(record.id.scene, "0001");
  EXPECT_EQ(urban.scenes, 1U);
  EXPECT_EQ(urban.planned, 16U);
  EXPECT_EQ(urban.summary.rows.front().scenes.size(), 1U);
  const Results one = restricted(results, {{"no volume"}, {"right"}, {}});
  EXPECT_EQ(variants_of(one.summary), (Names{"no volume"}));
  EXPECT_EQ(sensors_of(one.summary), (Names{"right"}));
  EXPECT_NE(refusal([&] {
              restricted(results, {{}, {}, {"urbn"}});
            }).find("--kinds: unknown name \"urbn\"; did you mean \"urban\"?"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              restricted(results, {{"bas"}, {}, {}});
            }).find("--variants"),
            std::string::npos);
}

}  // namespace
}  // namespace croon::experiments
