#include "experiments/report/result_tables.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <type_traits>

#include "framework/base/text.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

using Json = nlohmann::ordered_json;

/// Ratio and interval ends of a share called `name`.
Columns<Share> share_columns(const std::string& name) {
  Columns<Share> columns;
  return columns.add({name, "ratio", "/" + name + "/ratio", 1}, &Share::ratio)
      .add({name + "_low", "ratio", "/" + name + "/low_ratio", 1},
           [](const Share& share) { return low_of(share.interval); })
      .add({name + "_high", "ratio", "/" + name + "/high_ratio", 1},
           [](const Share& share) { return high_of(share.interval); });
}

/// `value` of a summary; nothing if it requires ground truth and there is none.
template <class T>
auto with_truth(T value) {
  return [value](const TrialSummary& summary) {
    using Result = std::decay_t<decltype(std::invoke(value, summary))>;
    return lacks_truth(summary) ? std::nullopt : std::optional<Result>(std::invoke(value, summary));
  };
}

/// The numbers of trials by outcome, and the shares of success and agreement.
Columns<TrialSummary> outcome_columns() {
  using S = TrialSummary;
  Columns<S> columns;
  return columns.add({"trials"}, [](const S& s) { return s.outcomes.trials; })
      .add({"success", "", "/success/count"},
           with_truth([](const S& s) { return s.outcomes.success; }))
      .add({"inaccurate"}, with_truth([](const S& s) { return s.outcomes.inaccurate; }))
      .add({"finished"}, [](const S& s) { return s.outcomes.finished; })
      .add({"rejected"}, [](const S& s) { return s.outcomes.rejected; })
      .add({"failed"}, [](const S& s) { return s.outcomes.failed; })
      .add(share_columns("success"), with_truth(&S::success))
      .add({"agreement", "", "/agreement/count"},
           [](const S& s) {
             const Share* const share = agreement_of(s);
             return share ? std::optional<int>(share->count) : std::nullopt;
           })
      .add(share_columns("agreement"), [](const S& s) {
        const Share* const share = agreement_of(s);
        return share ? std::optional<Share>(*share) : std::nullopt;
      });
}

/// Every statistic of every measure. `of` is a prefix of the names: "usable_".
Columns<std::optional<StatisticsTable>> statistics_columns(const std::string& of = "") {
  Columns<std::optional<StatisticsTable>> columns;
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    for (std::size_t s = 0; s < kStatistics.size(); ++s) {
      const std::string name = kStatistics[s].name;
      const std::string path = "/" + of + "statistics/" + name_with_unit(kMeasures[k]) + "/" + name;
      Column column = statistic_column(kMeasures[k], name, path);
      column.name = of + column.name;
      columns.add(column, [k, s](const auto& table) { return value_of(table, k, s); });
    }
  }
  return columns;
}

/// The scenes of a summary, found by variant, sensor and scene.
class ScenesByName {
 public:
  explicit ScenesByName(const Summary& summary) : bounds_(pose_bounds(summary.bounds)) {
    for (const SummaryRow& row : summary.rows) {
      for (const SceneSummary& scene : row.scenes) {
        scenes_[{row.variant, row.sensor, scene.scene}] = &scene;
      }
    }
  }

  /// Whether a trial agrees with its scene; nothing if it has no usable pose.
  std::optional<bool> agrees(const TrialRecord& record) const {
    const TrialId& id = record.id;
    const auto scene = scenes_.find({id.variant, id.sensor, id.scene});
    if (scene == scenes_.end()) return std::nullopt;
    return experiments::agrees(record, *scene->second, bounds_);
  }

 private:
  PoseBounds bounds_;
  std::map<std::tuple<std::string, std::string, std::string>, const SceneSummary*> scenes_;
};

Columns<TrialRecord> trial_columns(const ScenesByName& scenes) {
  Columns<PoseError> errors;  // First the two distances, then the DOFs.
  for (const std::size_t k : {kRotation, kTranslation, 0UL, 1UL, 2UL, 3UL, 4UL, 5UL}) {
    errors.add({std::string(kMeasures[k].name) + "_error", kMeasures[k].unit},
               [k](const PoseError& error) { return measures_of(error)[k]; });
  }
  using R = TrialRecord;
  Columns<R> columns;
  return columns.add(id_columns(), &R::id)
      .add({"status"}, [](const R& record) { return status_name(record.status); })
      .add(errors, &R::error)
      .add(pose_columns(), &R::T_reference_sensor)
      .add({"agrees"}, [&](const R& record) { return scenes.agrees(record); });
}

/// The number of counted trials and their statistics.
Columns<TrialSummary> counted_columns() {
  Columns<TrialSummary> columns;
  return columns.add({"counted"}, &TrialSummary::counted)
      .add(statistics_columns(), &TrialSummary::statistics);
}

/// The columns of summary.csv; `consensus` appears only in JSON.
Columns<SummaryRow> summary_columns(const Columns<SummaryRow>& consensus = {}) {
  Columns<SummaryRow> columns;
  columns.add({"variant"}, &SummaryRow::variant)
      .add({"sensor"}, &SummaryRow::sensor)
      .add({"reference"}, [](const SummaryRow& row) { return name_of(row.deviations_from); });
  columns.add(outcome_columns()).add(consensus).add(counted_columns());
  return columns.add(dof_columns("within_scene_std"), &SummaryRow::within_scene_std)
      .add(dof_columns("across_scenes_std"), &SummaryRow::across_scenes_std)
      .add({"usable"}, &SummaryRow::usable)
      .add(statistics_columns("usable_"), &SummaryRow::usable_statistics);
}

Columns<PairedTest> test_columns(const std::string& name, const std::string& path) {
  Columns<PairedTest> columns;
  return columns.add({name + "_p", "", path + "/p", 3}, &PairedTest::p)
      .add({name + "_p_holm", "", path + "/p_holm", 3}, &PairedTest::p_holm)
      .add({name + "_p_by_scene", "", path + "/p_by_scene", 3}, &PairedTest::p_by_scene)
      .add({name + "_p_by_scene_holm", "", path + "/p_by_scene_holm", 3},
           &PairedTest::p_by_scene_holm)
      .add({name + "_significant", "", path + "/is_significant"}, is_significant)
      .add({name + "_by_scene", "", path + "/holds_by_scene"}, is_significant_by_scene);
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
  add("low", [](const E& error) { return low_of(error.interval); });
  add("high", [](const E& error) { return high_of(error.interval); });
  add("paired_difference", &E::paired_difference);
  add("paired_low", [](const E& error) { return low_of(error.paired_interval); });
  add("paired_high", [](const E& error) { return high_of(error.paired_interval); });
  return columns.add(test_columns(measure.name, path + "wilcoxon"), &E::test);
}

/// The closure of the loop over the poses that all scenes agree on.
Columns<LoopGap> gap_columns() {
  Columns<LoopGap> columns;
  columns.add({"agreed_closed", "", "/agreed/is_closed"}, &LoopGap::is_closed);
  for (const std::size_t k : kDistances) {
    const Measure& measure = kMeasures[k];
    columns.add({std::string("agreed_") + measure.name, measure.unit,
                 "/agreed/" + name_with_unit(measure), measure.decimals},
                [k](const LoopGap& gap) { return gap.deviations[k]; });
  }
  return columns;
}

Json scenes_json(const SummaryRow& row) {
  if (row.scenes.size() > kMaxJsonScenes) return nullptr;
  Columns<SceneSummary> columns;
  columns.add({"scene"}, &SceneSummary::scene).add(outcome_columns());
  columns.add(pose_columns("/consensus"), &SceneSummary::consensus).add(counted_columns());
  return json_rows(columns.table(row.scenes));
}

}  // namespace

Column statistic_column(const Measure& measure, const std::string& statistic,
                        const std::string& path) {
  return {measure.name + ("_" + statistic), measure.unit, path, measure.decimals,
          Better::nearer_to_zero};
}

Columns<DofValues> dof_columns(const std::string& name) {
  Columns<DofValues> columns;
  for (std::size_t k = 0; k < kDofs; ++k) {
    columns.add(
        statistic_column(kMeasures[k], name, "/" + name + "/" + name_with_unit(kMeasures[k])),
        [k](const DofValues& values) { return values[k]; });
  }
  return columns;
}

Columns<SceneKindSummary> scene_kind_columns() {
  Columns<SceneKindSummary> columns;
  columns.add({"variant"}, &SceneKindSummary::variant).add({"kind"}, &SceneKindSummary::scene_kind);
  add_sensor(columns);
  return columns.add({"reference"}, [](const auto& row) { return name_of(row.deviations_from); })
      .add({"scenes"}, &SceneKindSummary::scene_count)
      .add(outcome_columns())
      .add(counted_columns());
}

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

Columns<DofComparison> dof_comparison_columns() {
  using C = DofComparison;
  Columns<C> columns;
  columns.add({"variant"}, &C::variant).add({"base"}, &C::base);
  add_sensor(columns);
  const auto add = [&](const char* name, auto value) {
    columns.add({name}, [value](const C& of) { return std::invoke(value, of.error); });
  };
  columns.add({"dof"}, [](const C& of) { return kMeasures[of.dof].name; })
      .add({"unit"}, [](const C& of) { return kMeasures[of.dof].unit; })
      .add({"pairs"}, &C::pairs)
      .add({"scenes"}, &C::scenes);
  using E = ErrorComparison;
  add("base_median", &E::base_median);
  add("variant_median", &E::variant_median);
  add("paired_difference", &E::paired_difference);
  add("paired_low", [](const E& error) { return low_of(error.paired_interval); });
  add("paired_high", [](const E& error) { return high_of(error.paired_interval); });
  return columns.add(test_columns("wilcoxon", "/wilcoxon"),
                     [](const C& of) { return of.error.test; });
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
      .add(statistics_columns(), &L::statistics)
      .add({"scenes"}, &L::scenes)
      .add({"scenes_closed"}, &L::scenes_closed)
      .add(gap_columns(), &L::agreed);
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
  // One decimal more than the paper's tables, to show on which side of the end of its band a number
  // lies.
  constexpr int kDecimals = 5;
  static constexpr int kPercentDecimals = 2;
  Columns<Claim> of_claim;
  of_claim.add({"claim"}, &Claim::claim)
      .add({"source"}, &Claim::source)
      .add({"variant"}, &Claim::variant)
      .add({"sensor"}, [](const Claim& claim) { return nothing_if_empty(claim.sensor); })
      .add({"measure"}, [](const Claim& claim) { return nothing_if_empty(claim.measure); })
      .add({"statistic"}, &Claim::statistic)
      .add({"over"}, [](const Claim& claim) { return word_of_over(claim.over); })
      .add({"unit"}, unit_of)
      .add({"expected", "", "", kAllDigits}, &Claim::value)
      .add({"low", "", "/band/0", kAllDigits},
           [](const Claim& claim) { return claim.band.front(); })
      .add({"high", "", "/band/1", kAllDigits},
           [](const Claim& claim) { return claim.band.back(); });
  using R = ClaimResult;
  const auto found = [](const R& result) {
    Cell cell = to_cell(result.found);
    if (is_share(result.claim.statistic)) cell.decimals = kPercentDecimals;
    return cell;
  };
  Columns<R> columns;
  return columns.add(of_claim, &R::claim)
      .add({"found", "", "", kDecimals}, found)
      .add({"verdict"}, [](const R& result) { return name_of(result.outcome); })
      .add({"trials"}, &R::trials)
      .add({"scenes"}, &R::scenes)
      .add({"success", "percent", "", 1}, &R::success_percent)
      .add({"can_fail"}, &R::can_fail);
}

Columns<FrameSummary> frame_columns() {
  using F = FrameSummary;
  Columns<F> columns;
  return columns.add({"variant"}, &F::variant)
      .add({"scenes"}, [](const F& row) { return row.frames.trials; })
      .add({"success", "", "/success/count"}, [](const F& row) { return row.frames.count; })
      .add(share_columns("success"), &F::frames);
}

Columns<ReasonCount> reason_columns() {
  Columns<ReasonCount> columns;
  return columns.add({"variant"}, &ReasonCount::variant)
      .add({"status"}, [](const ReasonCount& reason) { return status_name(reason.status); })
      .add({"reason"}, &ReasonCount::reason)
      .add({"count"}, &ReasonCount::count);
}

namespace {

Columns<DiagnosticSummary> diagnostic_columns() {
  using D = DiagnosticSummary;
  Columns<D> columns;
  return columns.add({"variant"}, &D::variant)
      .add({"step"}, &D::step)
      .add({"name"}, &D::name)
      .add({"trials"}, &D::trials)
      .add({"median"}, &D::median);
}

}  // namespace

bool has_deviations_from(const Table& table, DeviationsFrom from) {
  const std::size_t k = table.index_of("reference");
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const CellRow& row) {
    return row[k].value == Value(std::string(name_of(from)));
  });
}

std::vector<std::string> share_names(const Table& table) {
  std::vector<std::string> names;
  const bool has_consensus = has_deviations_from(table, DeviationsFrom::consensus);
  if (!has_consensus || has_deviations_from(table, DeviationsFrom::truth)) {
    names.emplace_back("success");
  }
  if (has_consensus) names.emplace_back("agreement");
  return names;
}

std::string with_interval(double value, const std::optional<Interval>& interval, int decimals,
                          double scale) {
  const auto text = [&](double number) { return fixed_number(scale * number, decimals); };
  if (!interval) return text(value);
  return text(value) + " [" + text(interval->low) + ", " + text(interval->high) + "]";
}

std::string bounds_text(const SuccessBounds& bounds) {
  return shortest_number(bounds.rotation_deg) + " deg and " +
         shortest_number(bounds.translation_m) + " m of ";
}

std::string title_of(const Measure& measure) {
  return std::string(measure.name) + " " + measure.unit;
}

std::vector<Column> trial_rows(const std::vector<TrialRecord>& records, const Summary& summary,
                               const RowUse& use) {
  const ScenesByName scenes(summary);
  Columns<TrialRecord> columns = trial_columns(scenes);
  return use_rows(columns.add({"reason"}, &TrialRecord::reason), records, use);
}

std::vector<Column> summary_rows(const Summary& summary, const RowUse& use) {
  return use_rows(summary_columns(), summary.rows, use);
}

std::string trials_csv(const std::vector<TrialRecord>& records, const Summary& summary) {
  return csv_of(trial_columns(ScenesByName(summary)), records);
}

std::string summary_csv(const Summary& summary) { return csv_of(summary_columns(), summary.rows); }

std::string clouds_csv(const std::vector<CloudDescription>& clouds) {
  return csv_of(cloud_columns(), clouds);
}

std::string summary_json(const Summary& summary, const std::vector<ClaimResult>& claims,
                         const std::vector<DiagnosticSummary>& diagnostics) {
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
  add("frames", frame_columns().table(summary.frames));
  add("kinds", scene_kind_columns().table(summary.scene_kinds));
  add("loops", loop_columns().table(summary.loops));
  add("claims", claim_columns().table(claims));
  add("diagnostics", diagnostic_columns().table(diagnostics));
  return json_bytes(json);
}

}  // namespace croon::experiments
