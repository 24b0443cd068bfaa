#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/report/export_choice.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;

const std::string kCommit = "0123456789abcdef0123456789abcdef01234567";

ExportTable table_of(const std::vector<TrialRecord>& records) {
  return export_table(summarise(records, kBounds, {}),
                      {"few_records", kCommit, 7, 2, 4, records.size(), 32});
}

/// The LaTeX table of these columns.
std::string latex_of(ExportTable table, const std::vector<std::string>& columns) {
  choose(table, {{}, columns});
  return export_latex(table);
}

/// One trial of a variant, `x_m` off the truth.
TrialRecord trial_at(const std::string& variant, int trial, double x_m) {
  return test::finished({variant, "0001", "left", trial}, Status::success, {},
                        test::offset_of(0.0, 0.0, 0.0, x_m, 0.0, 0.0));
}

/// "left/base"; "/base" for all sensors.
std::string name_of(const ExportTable& table, std::size_t row) {
  return table.table.text_at(row, "sensor") + "/" + table.table.text_at(row, "variant");
}

/// The variants whose value is the best of a column, sensor by sensor.
std::vector<std::string> best_of(const ExportTable& table, std::size_t column) {
  std::vector<std::string> best;
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    if (table.table.rows[i][column].is_best) best.push_back(name_of(table, i));
  }
  return best;
}

std::size_t column(const std::string& name) { return export_table({}, {}).table.index_of(name); }

/// A number of the table; NaN if there is none.
double number(const ExportTable& table, std::size_t row, const std::string& name) {
  const Value& value = table.table.at(row, name).value;
  if (const auto* count = std::get_if<long long>(&value)) return static_cast<double>(*count);
  const auto* number = std::get_if<double>(&value);
  return number == nullptr ? std::nan("") : *number;
}

/// The names of the columns with results.
std::vector<std::string> result_names(const ExportTable& table) {
  std::vector<std::string> names;
  for (const Column& column : table.table.columns) names.push_back(column.full_name());
  return {names.begin() + 7, names.end()};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

using Names = std::vector<std::string>;

TEST(ExportTable, HasARowPerSensorAndVariantAndOneOfAllSensors) {
  const ExportTable table = table_of(test::few_records());
  Names rows;
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    rows.push_back(name_of(table, i));
    EXPECT_EQ(table.table.rows[i].size(), table.table.columns.size());
  }
  EXPECT_EQ(rows, (Names{"left/base", "left/no volume", "right/base", "right/no volume", "/base",
                         "/no volume"}));
  EXPECT_EQ(number(table, 4, "trials"), 15);
  EXPECT_EQ(number(table, 4, "success"), 12);
  EXPECT_EQ(number(table, 4, "success_percent"), 80.0);
}

TEST(ExportTable, PoolsTheTrialsOfAllSensors) {
  Rng rng = croon::test::test_rng();
  std::vector<TrialRecord> records;
  std::vector<TrialRecord> as_one_sensor;
  for (int trial = 0; trial < 40; ++trial) {
    const Vector6d offset = test::random_offset(rng, 0.2, 0.03);
    const char* sensor = trial % 3 == 0 ? "left" : "right";
    const std::string scene = std::to_string(trial / 3 % 7);
    records.push_back(test::finished({"base", scene, sensor, trial}, Status::success, {}, offset));
    as_one_sensor.push_back(
        test::finished({"base", scene, "one", trial}, Status::success, {}, offset));
  }
  const ExportTable pooled = table_of(records);
  const ExportTable one = table_of(as_one_sensor);
  ASSERT_EQ(result_names(one).size(), 29U);
  for (const std::string& name : result_names(one)) {
    if (name.find("paired") != std::string::npos) continue;     // There is one variant.
    if (name.find("agreement") != std::string::npos) continue;  // With a pose of each sensor.
    EXPECT_NEAR(number(pooled, pooled.table.rows.size() - 1, name), number(one, 0, name), 1e-12)
        << name;
  }
}

TEST(ExportTable, TellsTheBestOfEachSensor) {
  const ExportTable table = table_of(test::few_records());
  EXPECT_EQ(best_of(table, column("success_percent")),
            (Names{"left/base", "left/no volume", "right/no volume", "/no volume"}));
  EXPECT_EQ(best_of(table, column("rotation_median_deg")), (Names{"left/base", "right/no volume"}));
  // -0.01 is nearer to zero than -0.02. But on the right, and of all, base succeeds less often by
  // more than 5 points.
  EXPECT_EQ(best_of(table, column("pitch_mean_deg")),
            (Names{"left/base", "right/no volume", "/no volume"}));
  EXPECT_TRUE(best_of(table, column("success_low_percent")).empty());
}

TEST(ExportTable, AllThatLookEquallyGoodAreTheBest) {
  const std::size_t x_mean = column("x_mean_m");
  const ExportTable near =
      table_of({trial_at("a", 0, 0.02000), trial_at("b", 0, -0.02001), trial_at("c", 0, 0.0202)});
  EXPECT_EQ(best_of(near, x_mean), (Names{"left/a", "left/b"}));
}

TEST(ExportTable, OneVariantAloneIsNotTheBest) {
  const ExportTable table = table_of({trial_at("a", 0, 0.01), trial_at("a", 1, 0.02)});
  for (const Cell& cell : table.table.rows.front()) EXPECT_FALSE(cell.is_best);
  EXPECT_FALSE(has(latex_of(table, {"x"}), "\\bfseries 0"));
  EXPECT_FALSE(has(export_markdown(table), "**"));
  EXPECT_FALSE(has(export_markdown(table), "differs"));
}

TEST(ExportTable, LacksWhatTooFewTrialsTell) {
  const TrialId id = {"none", "0001", "left", 0};
  const ExportTable table =
      table_of({trial_at("one", 0, 0.01), test::unfinished(id, Status::failed, "no ground")});
  const std::size_t none = table.table.text_at(0, "variant") == "none" ? 0 : 1;
  const std::size_t one = 1 - none;
  EXPECT_EQ(number(table, none, "success_percent"), 0.0);
  for (std::size_t k = column("rotation_median_deg"); k < table.table.columns.size(); ++k) {
    EXPECT_TRUE(table.table.rows[none][k].is_nothing());
    EXPECT_FALSE(table.table.rows[none][k].is_best);
  }
  EXPECT_EQ(number(table, one, "x_mean_m"), 0.01);
  EXPECT_TRUE(table.table.at(one, "x_std_m").is_nothing());
  EXPECT_TRUE(has(latex_of(table, {"x"}), "& \\multicolumn{2}{c}{--} \\\\"));
  EXPECT_TRUE(has(export_markdown(table), "| - | - |"));
  EXPECT_TRUE(has(export_csv(table), ",,,,,,\n"));
  EXPECT_TRUE(nlohmann::json::parse(export_json(table))["rows"][0]["x_std_m"].is_null());
}

TEST(ExportTable, WithoutTruthTellsOfTheConsensus) {
  const ExportTable table = table_of(test::one_of_four_astray());
  EXPECT_EQ(table.table.text_at(0, "reference"), "consensus");
  EXPECT_TRUE(table.table.at(0, "success").is_nothing());
  EXPECT_TRUE(table.table.at(0, "success_percent").is_nothing());
  EXPECT_EQ(number(table, 0, "agreement"), 3);
  EXPECT_EQ(number(table, 0, "agreement_percent"), 75.0);
  const std::string text = export_markdown(table);
  EXPECT_TRUE(has(text, "no ground truth"));
  EXPECT_FALSE(has(text, "of ground truth"));
  EXPECT_FALSE(has(text, "uccess"));
  EXPECT_TRUE(has(latex_of(table, {"agreement"}), "agreement (\\%)"));
}

TEST(ExportTable, MarksWhatDiffersFromTheBase) {
  Summary summary = summarise(test::few_records(), kBounds, {});
  Comparison comparison;
  comparison.variant = "no volume";
  comparison.base = "base";
  comparison.rotation_deg.test = {false, 1e-4, 1e-3, 1e-4, 1e-3};
  comparison.translation_m.test = {true, 1e-4, 1e-3, 0.4, 0.4};
  summary.comparisons = {comparison};
  const ExportTable table = export_table(summary, {"few", kCommit, 7, 2, 4, 29, 32});
  const std::size_t all = table.table.rows.size() - 1;
  EXPECT_EQ(table.table.at(all, "success_percent").mark, "");
  EXPECT_EQ(table.table.at(all, "rotation_median_deg").mark, "-**");
  EXPECT_EQ(table.table.at(all, "translation_median_m").mark, "+*");
  EXPECT_EQ(table.table.at(1, "rotation_median_deg").mark, "");
  EXPECT_TRUE(has(caption_sentences(table).back(), "differs from base"));
  EXPECT_TRUE(has(export_markdown(table), "| 0.035 -\\*\\* |"));
  EXPECT_TRUE(has(latex_of(table, {"rotation_median", "rotation_p95", "rotation_paired"}),
                  "& 0.035 & $-$** & \\bfseries 0.060"));
  EXPECT_TRUE(has(export_csv(table), ",,-**,+*\n"));
  EXPECT_EQ(nlohmann::json::parse(export_json(table))["rows"][5]["marks"]["translation_median_m"],
            "+*");
}

/// Two variants of which the second finishes 19 of 20 trials, and these with lesser errors.
Summary with_survivors(double p) {
  std::vector<TrialRecord> records;
  for (int i = 0; i < 20; ++i) {
    records.push_back(trial_at("base", i, 0.02));
    records.push_back(i > 0 ? trial_at("lucky", i, 0.01)
                            : test::unfinished({"lucky", "0001", "left", i}, Status::failed, "no"));
  }
  Summary summary = summarise(records, kBounds, {});
  for (Comparison& comparison : summary.comparisons) {
    comparison.success.p_holm = p;
    comparison.success.favours_variant = false;
  }
  return summary;
}

TEST(ExportTable, SurvivorsOfFewerTrialsAreNotTheBest) {
  const std::size_t k = column("translation_median_m");
  const auto is_best = [&](double p, std::size_t row) {
    return export_table(with_survivors(p), {"few", kCommit, 7, 1, 8, 16, 16})
        .table.rows[row][k]
        .is_best;
  };
  EXPECT_TRUE(is_best(0.01, 0));  // The base; the other succeeds significantly less often.
  EXPECT_FALSE(is_best(0.01, 1));
  EXPECT_FALSE(is_best(0.5, 0));
  EXPECT_TRUE(is_best(0.5, 1));
}

TEST(ExportTable, AVariantThatSucceedsFarLessOftenIsNeverTheBest) {
  // 5 of 12 against 11 of 12: 42 % against 92 %, neither differs significantly from the base.
  std::vector<TrialRecord> records;
  for (int i = 0; i < 12; ++i) {
    const auto add = [&](const char* variant, bool is_good, double x_m) {
      records.push_back(is_good
                            ? trial_at(variant, i, x_m)
                            : test::unfinished({variant, "0001", "left", i}, Status::failed, "no"));
    };
    add("base", i % 3 != 0, 0.03);
    add("often", i != 6, 0.02);
    add("seldom", i < 5, 0.01);
  }
  const ExportTable table = table_of(records);
  for (const char* name : {"translation_median_m", "translation_p95_m", "x_mean_m"}) {
    EXPECT_EQ(best_of(table, column(name)), (Names{"left/often"})) << name;
  }
}

TEST(ExportTable, ShowsTheIntervalOfThePairedDifferenceBesideTheMark) {
  // Medians that look equal, though each trial of the second is 0.02 mm worse.
  std::vector<TrialRecord> records;
  for (int i = 0; i < 40; ++i) {
    const double x_m = 0.02 + 1e-6 * i;
    for (const char* variant : {"base", "other"}) {
      TrialRecord record = trial_at(variant, i, x_m + (*variant == 'o' ? 2e-5 : 0.0));
      record.id.scene = std::to_string(i % 10);
      records.push_back(record);
    }
  }
  const ExportTable table = table_of(records);
  EXPECT_EQ(table.table.at(1, "translation_median_m").mark, "-**");
  EXPECT_NEAR(number(table, 1, "translation_paired_difference_m"), 2e-5, 1e-12);
  EXPECT_TRUE(table.table.at(0, "translation_paired_low_m").is_nothing());
  EXPECT_TRUE(has(export_markdown(table), "| 0.0200 -\\*\\* | 0.0201 | [0.00002, 0.00002] |"))
      << export_markdown(table);
  EXPECT_TRUE(has(latex_of(table, {"translation_median", "translation_p95", "translation_paired"}),
                  "& 0.0200 & $-$** & 0.0201 & 0.00002 & 0.00002 "));
}

TEST(ExportTable, WithoutTruthMarksNoErrors) {
  std::vector<TrialRecord> records;
  for (int i = 0; i < 4; ++i) {
    for (const char* variant : {"base", "other"}) {
      records.push_back(test::finished_without_truth({variant, "0001", "left", i}, {}));
    }
  }
  Summary summary = summarise(records, kBounds, {});
  for (Comparison& comparison : summary.comparisons) {
    comparison.success.p_holm = comparison.rotation_deg.test.p_holm = 0.001;
  }
  const ExportTable table = export_table(summary, {"few", kCommit, 7, 1, 4, 8, 8});
  EXPECT_EQ(table.table.at(1, "agreement_percent").mark, "-*");
  EXPECT_EQ(table.table.at(1, "rotation_median_deg").mark, "");
}

TEST(ExportCaption, NamesWhatTheNumbersAreOf) {
  const std::vector<std::string> sentences = caption_sentences(table_of(test::few_records()));
  EXPECT_EQ(sentences.at(0), "few_records (croon, commit 0123456789ab, seed 7).");
  EXPECT_EQ(sentences.at(1),
            "2 scenes, 2 sensors, 2 variants, 4 starts of each: 29 of 32 trials; a row has 6 to 15 "
            "of 2 scenes.");
  EXPECT_EQ(sentences.at(2),
            "Success: within 0.5 deg and 0.1 m of ground truth; errors are over these trials.");
}

TEST(ExportCaption, KeepsThatTheProgramHadBeenChanged) {
  ExportTable table = table_of(test::few_records());
  table.caption.commit += "-dirty";
  EXPECT_TRUE(has(caption_sentences(table).at(0), "commit 0123456789ab-dirty,"));
  table.caption.commit = "unknown";
  EXPECT_TRUE(has(caption_sentences(table).at(0), "commit unknown,"));
}

TEST(ExportLatex, BoldsTheBestAndAlignsTheDigits) {
  auto records = test::few_records();
  for (TrialRecord& record : records) record.id.scene += "-" + std::to_string(record.id.trial);
  const std::string text = latex_of(table_of(records), {"success", "success_interval", "pitch"});
  EXPECT_TRUE(has(text, "\\bfseries -0.010"));
  EXPECT_TRUE(has(text, "& \\bfseries 100.0 & 61.0 & 100.0 "));
  EXPECT_TRUE(has(text, "S[table-format=-1.3]@{\\,${}\\pm{}$\\,}"));
  EXPECT_TRUE(has(text, "S[table-format=3.1]"));
  EXPECT_TRUE(has(text, "\\label{tab:few_records}"));
}

TEST(ExportMarkdown, IsATableOfEqualRows) {
  auto records = test::few_records();
  for (TrialRecord& record : records) {
    if (record.id.variant == "base") record.id.variant = "a|b *c*";
  }
  std::istringstream text(export_markdown(table_of(records)));
  std::vector<std::ptrdiff_t> bars;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line[0] != '|') continue;
    std::ptrdiff_t escaped = 0;
    for (std::size_t at = 0; (at = line.find("\\|", at)) != std::string::npos; ++at) ++escaped;
    bars.push_back(std::count(line.begin(), line.end(), '|') - escaped);
  }
  EXPECT_EQ(bars, std::vector<std::ptrdiff_t>(8, 17));
  EXPECT_TRUE(has(text.str(), "| a\\|b \\*c\\* | left |"));
}

TEST(ExportCsv, HoldsFullPrecisionInAsManyFieldsPerLine) {
  const ExportTable table = table_of(test::few_records());
  std::istringstream text(export_csv(table));
  std::string line;
  std::size_t lines = 0;
  for (; std::getline(text, line); ++lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6 + 29 + 4) << line;
  }
  EXPECT_EQ(lines, 1 + table.table.rows.size());
  EXPECT_TRUE(has(text.str(), "\nno volume,all,truth,2,14,12,12,85.71428571428571,"));
}

TEST(ExportJson, HoldsTheSameNumbers) {
  const ExportTable table = table_of(test::few_records());
  const auto parsed = nlohmann::json::parse(export_json(table));
  EXPECT_EQ(parsed["commit"], kCommit);
  EXPECT_EQ(parsed["seed"], 7);
  ASSERT_EQ(parsed["rows"].size(), table.table.rows.size());
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    for (const std::string& name : result_names(table)) {
      const auto& value = parsed["rows"][i][name];
      ASSERT_EQ(value.is_null(), table.table.at(i, name).is_nothing()) << name;
      if (value.is_null()) continue;
      EXPECT_EQ(value, number(table, i, name));
    }
  }
  EXPECT_TRUE(parsed["rows"].back()["sensor"].is_null());
  EXPECT_EQ(parsed["rows"][0]["best"][0], "success_percent");
}

TEST(Export, OfNoTrialsIsAnEmptyTable) {
  const ExportTable table = table_of({});
  EXPECT_TRUE(table.table.rows.empty());
  EXPECT_TRUE(nlohmann::json::parse(export_json(table))["rows"].empty());
  EXPECT_TRUE(has(latex_of(table, {"success"}), "\\bottomrule"));
}

}  // namespace
}  // namespace croon::experiments
