#include "experiments/report/result_tables.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/report/columns.hpp"
#include "experiments/report/renderers.hpp"

namespace croon::experiments {

namespace {

using Json = nlohmann::ordered_json;

Columns<TrialId> id_columns() {
  Columns<TrialId> columns;
  return columns.add({"variant"}, &TrialId::variant)
      .add({"scene"}, &TrialId::scene)
      .add({"sensor"}, &TrialId::sensor)
      .add({"trial"}, &TrialId::trial);
}

Columns<TrialRecord> trial_columns() {
  Columns<TrialRecord> columns;
  columns.add(id_columns(), &TrialRecord::id).add({"status"}, [](const TrialRecord& record) {
    return status_name(record.status);
  });
  // The two distances first, then the DOFs.
  constexpr std::size_t kOrder[] = {kRotation, kTranslation, 0, 1, 2, 3, 4, 5};
  for (const std::size_t k : kOrder) {
    columns.add({std::string(kMeasures[k].name) + "_error", kMeasures[k].unit},
                [k](const TrialRecord& record) {
                  return record.error ? std::optional<double>(measures_of(*record.error)[k])
                                      : std::nullopt;
                });
  }
  return columns.add(pose_columns(), &TrialRecord::T_reference_sensor);
}

/// The columns of summary.csv; `consensus` is in JSON alone.
Columns<SummaryRow> summary_columns(const Columns<SummaryRow>& consensus = {}) {
  Columns<SummaryRow> columns;
  columns.add({"variant"}, &SummaryRow::variant)
      .add({"sensor"}, &SummaryRow::sensor)
      .add({"reference"}, [](const SummaryRow& row) { return name_of(row.deviations_from); });
  columns.add(outcome_columns()).add(consensus).add(counted_columns());
  return columns.add(dof_columns("within_scene_std"), &SummaryRow::within_scene_std)
      .add(dof_columns("across_scenes_std"), &SummaryRow::across_scenes_std);
}

Columns<SceneKindSummary> scene_kind_columns() {
  Columns<SceneKindSummary> columns;
  columns.add({"variant"}, &SceneKindSummary::variant).add({"kind"}, &SceneKindSummary::scene_kind);
  add_sensor(columns);
  return columns.add({"reference"}, [](const auto& row) { return name_of(row.deviations_from); })
      .add({"scenes"}, &SceneKindSummary::scenes)
      .add(outcome_columns())
      .add(counted_columns());
}

Columns<PairedTest> test_columns(const std::string& name, const std::string& path) {
  Columns<PairedTest> columns;
  return columns.add({name + "_p", "", path + "/p", 3}, &PairedTest::p)
      .add({name + "_p_holm", "", path + "/p_holm", 3}, &PairedTest::p_holm)
      .add({name + "_p_by_scene", "", path + "/p_by_scene", 3}, &PairedTest::p_by_scene)
      .add({name + "_p_by_scene_holm", "", path + "/p_by_scene_holm", 3},
           &PairedTest::p_by_scene_holm)
      .add({name + "_significant", "", path + "/is_significant"}, is_significant)
      .add({name + "_by_scene", "", path + "/holds_by_scene"}, holds_by_scene);
}

Columns<ErrorComparison> error_columns(const Measure& measure) {
  using E = ErrorComparison;
  const std::string path = "/" + name_with_unit(measure) + "/";
  Columns<E> columns;
  const auto add = [&](const std::string& name, auto value) {
    columns.add(
        {std::string(measure.name) + "_" + name, measure.unit, path + name, measure.decimals},
        value);
  };
  add("base_median", &E::base_median);
  add("variant_median", &E::variant_median);
  add("difference", &E::difference);
  add("low", [](const E& error) { return error.interval.low; });
  add("high", [](const E& error) { return error.interval.high; });
  return columns.add(test_columns(measure.name, path + "wilcoxon"), &E::test);
}

Json scenes_json(const SummaryRow& row) {
  if (row.scenes.size() > kMaxJsonScenes) return nullptr;
  Columns<SceneSummary> columns;
  columns.add({"scene"}, &SceneSummary::scene).add(outcome_columns());
  columns.add(pose_columns("/consensus"), &SceneSummary::consensus).add(counted_columns());
  return json_rows(columns.table(row.scenes));
}

Columns<ReasonCount> reason_columns() {
  Columns<ReasonCount> columns;
  return columns.add({"variant"}, &ReasonCount::variant)
      .add({"status"}, [](const ReasonCount& reason) { return status_name(reason.status); })
      .add({"reason"}, &ReasonCount::reason)
      .add({"count"}, &ReasonCount::count);
}

/// A level of a row of a basin.
struct BasinLevel {
  const BasinRow& row;
  int level;
  double size;
  const char* unit;
};

}  // namespace

Columns<Comparison> comparison_columns() {
  Columns<Comparison> columns;
  columns.add({"variant"}, &Comparison::variant).add({"base"}, &Comparison::base);
  add_sensor(columns);
  return columns.add({"pairs"}, &Comparison::pairs)
      .add({"scenes"}, &Comparison::scenes)
      .add({"only_base"}, &Comparison::only_base)
      .add({"only_variant"}, &Comparison::only_variant)
      .add(error_columns(kMeasures[kRotation]), &Comparison::rotation_deg)
      .add(error_columns(kMeasures[kTranslation]), &Comparison::translation_m)
      .add(test_columns("success", "/mcnemar"), &Comparison::success);
}

Columns<LoopClosure> loop_columns() {
  using L = LoopClosure;
  Columns<L> columns;
  return columns.add({"variant"}, &L::variant)
      .add({"pair"}, [](const L& loop) { return loop.pair.name; })
      .add({"source"}, [](const L& loop) { return loop.pair.source; })
      .add({"target"}, [](const L& loop) { return loop.pair.target; })
      .add({"loops"}, [](const L& loop) { return loop.closed.trials; })
      .add({"closed", "", "/closed/count"}, [](const L& loop) { return loop.closed.count; })
      .add(share_columns("closed"), &L::closed)
      .add({"counted"}, &L::counted)
      .add(statistics_columns(), &L::statistics);
}

Columns<CloudDescription> cloud_columns() {
  using C = CloudDescription;
  Columns<C> columns;
  return columns.add({"dataset"}, &C::dataset)
      .add({"scene"}, &C::scene)
      .add({"kind"}, &C::kind)
      .add({"sensor"}, &C::sensor)
      .add({"points"}, &C::points)
      .add({"ground_ratio", "", "", 2}, &C::ground_ratio)
      .add({"median_range_m", "", "", 1}, &C::median_range_m)
      .add({"occupied_volume_m3", "", "", 1}, &C::occupied_volume_m3)
      .add({"median_distance_m", "", "", 3}, &C::median_distance_m)
      .add({"overlap_ratio", "", "", 2}, &C::overlap_ratio);
}

Columns<ClaimResult> claim_columns() {
  // One decimal more than the paper's tables have, so that a number at the end of its band shows on
  // which side it is.
  constexpr int kDecimals = 5;
  static constexpr int kPercentDecimals = 2;
  using R = ClaimResult;
  Columns<R> columns;
  columns.add({"claim"}, [](const R& result) { return result.claim.claim; })
      .add({"source"}, [](const R& result) { return result.claim.source; })
      .add({"variant"}, [](const R& result) { return result.claim.variant; })
      .add({"sensor"}, [](const R& result) { return nothing_if_empty(result.claim.sensor); })
      .add({"measure"}, [](const R& result) { return nothing_if_empty(result.claim.measure); })
      .add({"statistic"}, [](const R& result) { return result.claim.statistic; });
  return columns.add({"unit"}, [](const R& result) { return unit_of(result.claim); })
      .add({"expected", "", "", kAllDigits}, [](const R& result) { return result.claim.value; })
      .add({"low", "", "/band/0", kAllDigits},
           [](const R& result) { return result.claim.band.front(); })
      .add({"high", "", "/band/1", kAllDigits},
           [](const R& result) { return result.claim.band.back(); })
      .add({"found", "", "", kDecimals},
           [](const R& result) {
             Cell cell = to_cell(result.found);
             if (is_share(result.claim.statistic)) cell.decimals = kPercentDecimals;
             return cell;
           })
      .add({"verdict"}, [](const R& result) { return verdict_name(result.verdict); });
}

std::string trials_csv(const std::vector<TrialRecord>& records) {
  return csv_of(trial_columns(), records);
}

std::string timings_csv(const std::vector<TimingRow>& rows) {
  Columns<TimingRow> columns;
  columns.add(id_columns(), &TimingRow::id)
      .add({"step"}, &TimingRow::step)
      .add({"seconds"}, &TimingRow::seconds);
  return csv_of(columns, rows);
}

std::string summary_csv(const Summary& summary) { return csv_of(summary_columns(), summary.rows); }

std::string summary_by_kind_csv(const Summary& summary) {
  return csv_of(scene_kind_columns(), summary.scene_kinds);
}

std::string comparison_csv(const Summary& summary) {
  return csv_of(comparison_columns(), summary.comparisons);
}

std::string loops_csv(const Summary& summary) { return csv_of(loop_columns(), summary.loops); }

std::string basin_csv(const Basin& basin) {
  Columns<BasinLevel> columns;
  const auto share = [](const BasinLevel& level) {
    return level.row.levels[static_cast<std::size_t>(level.level)];
  };
  columns.add({"variant"}, [](const BasinLevel& level) { return level.row.variant; })
      .add({"sensor"},
           [](const BasinLevel& level) {
             return level.row.sensor.empty() ? "all" : level.row.sensor;
           })
      .add({"level"}, &BasinLevel::level)
      .add({"size"}, &BasinLevel::size)
      .add({"unit"}, &BasinLevel::unit)
      .add({"trials"}, [=](const BasinLevel& level) { return share(level).trials; })
      .add({"success"}, [=](const BasinLevel& level) { return share(level).count; })
      .add({"success_ratio"}, [=](const BasinLevel& level) { return share(level).ratio; })
      .add({"low"}, [=](const BasinLevel& level) { return share(level).interval.low; })
      .add({"high"}, [=](const BasinLevel& level) { return share(level).interval.high; });
  std::vector<BasinLevel> levels;
  for (const BasinRow& row : basin.rows) {
    for (int level = 0; level < static_cast<int>(row.levels.size()); ++level) {
      levels.push_back({row, level, rounded_size(basin.sweep, level), size_unit(basin.sweep)});
    }
  }
  return csv_of(columns, levels);
}

std::string clouds_csv(const std::vector<CloudDescription>& clouds) {
  return csv_of(cloud_columns(), clouds);
}

std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims) {
  Columns<SummaryRow> consensus;
  consensus.add(pose_columns("/consensus"), &SummaryRow::consensus);
  Json json;
  json["success_bounds"] = {{"rotation_deg", summary.bounds.rotation_deg},
                            {"translation_m", summary.bounds.translation_m}};
  json["rows"] = json_rows(summary_columns(consensus).table(summary.rows));
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    json["rows"][i]["scenes"] = scenes_json(summary.rows[i]);
  }
  json["reasons"] = json_rows(reason_columns().table(summary.reasons));
  const auto add = [&](const char* key, const Table& table) {
    if (!table.rows.empty()) json[key] = json_rows(table);
  };
  add("comparisons", comparison_columns().table(summary.comparisons));
  add("kinds", scene_kind_columns().table(summary.scene_kinds));
  add("loops", loop_columns().table(summary.loops));
  add("claims", claim_columns().table(claims));
  return json_bytes(json);
}

}  // namespace croon::experiments
