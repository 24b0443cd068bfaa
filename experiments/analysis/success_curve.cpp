#include <array>
#include <cmath>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {
namespace {

constexpr std::array kCurves = {CurveOf::rotation, CurveOf::translation, CurveOf::both};

/// A hundredth to a hundred times the bounds, six thresholds per decade.
std::vector<SuccessBounds> thresholds_of(const SuccessBounds& bounds) {
  // Twelve digits: without the last bits, which a product of round numbers does not have.
  const auto rounded = [](double value) {
    double scale = 1.0;
    while (scale * value < 1e11) scale *= 10.0;
    return std::round(scale * value) / scale;
  };
  std::vector<SuccessBounds> thresholds;
  for (const double decade : {0.01, 0.1, 1.0, 10.0}) {
    for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
      const double factor = decade * step;
      thresholds.push_back(factor == 1.0 ? bounds
                                         : SuccessBounds{rounded(factor * bounds.rotation_deg),
                                                         rounded(factor * bounds.translation_m)});
    }
  }
  thresholds.push_back({100.0 * bounds.rotation_deg, 100.0 * bounds.translation_m});
  return thresholds;
}

bool is_within(const TrialRecord& record, const PoseBounds& bounds, CurveOf of) {
  if (usable_pose(record) == nullptr || !record.error) return false;
  const bool is_turned_little = record.error->rotation_rad <= bounds.rotation_rad;
  const bool is_near = record.error->translation_m <= bounds.translation_m;
  return (of == CurveOf::translation || is_turned_little) && (of == CurveOf::rotation || is_near);
}

using Counts = std::vector<SceneCounts>;  // By threshold.

/// Adds the trials of a scene to the counts of each threshold.
void add_scene(const std::string& scene, const SceneRecords& records, CurveOf of,
               const std::vector<SuccessBounds>& thresholds, Counts& counts) {
  counts.resize(thresholds.size());
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    const PoseBounds bounds = pose_bounds(thresholds[i]);
    int within = 0;
    for (const TrialRecord* record : records) within += is_within(*record, bounds, of);
    counts[i].add(scene, within, static_cast<int>(records.size()));
  }
}

/// The curves of `rows`, which are of one variant, as one.
std::vector<CurveRow> curves_of(const Rows& rows, const std::string& sensor,
                                const RecordGroups& groups,
                                const std::vector<SuccessBounds>& thresholds) {
  std::vector<CurveRow> curves;
  for (const CurveOf of : kCurves) {
    Counts counts;
    for (const SummaryRow* row : rows) {
      for (const SceneSummary& scene : row->scenes) {
        add_scene(scene.scene, groups.of(row->variant, row->sensor, scene.scene), of, thresholds,
                  counts);
      }
    }
    CurveRow& curve = curves.emplace_back(CurveRow{rows.front()->variant, sensor, of, {}});
    for (const SceneCounts& count : counts) curve.shares.push_back(count.share());
  }
  return curves;
}

}  // namespace

const char* name_of(CurveOf of) {
  return std::array{"rotation", "translation", "both"}.at(static_cast<std::size_t>(of));
}

SuccessCurve success_curve(const Summary& summary, const RecordGroups& groups) {
  if (summary.bounds.rotation_deg == 0.0 || summary.bounds.translation_m == 0.0) return {};
  SuccessCurve curve{thresholds_of(summary.bounds), {}};
  for (const std::string& variant : variants_of(summary)) {
    Rows with_truth;
    const auto add = [&](const Rows& rows, const std::string& sensor) {
      const auto curves = curves_of(rows, sensor, groups, curve.thresholds);
      curve.rows.insert(curve.rows.end(), curves.begin(), curves.end());
    };
    for (const SummaryRow* row : rows_of(summary, variant)) {
      if (row->deviations_from != DeviationsFrom::truth) continue;
      with_truth.push_back(row);
      add({row}, row->sensor);
    }
    if (!with_truth.empty()) add(with_truth, "");
  }
  return curve;
}

}  // namespace croon::experiments
