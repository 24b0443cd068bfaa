#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {
namespace {

constexpr std::array kCurves = {CurveOf::rotation, CurveOf::translation, CurveOf::both};

/// From a hundredth to a hundred times the bounds, six thresholds per decade.
std::vector<SuccessBounds> thresholds_of(const SuccessBounds& bounds) {
  // Rounded to twelve digits, to remove rounding errors of products of round numbers.
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

/// The thresholds of rotation, rad, and of translation, m, both ascending.
struct Thresholds {
  std::vector<double> rotation_rad, translation_m;

  explicit Thresholds(const std::vector<SuccessBounds>& all) {
    for (const SuccessBounds& one : all) {
      const PoseBounds bounds = pose_bounds(one);
      rotation_rad.push_back(bounds.rotation_rad);
      translation_m.push_back(bounds.translation_m);
    }
  }
  std::size_t size() const { return rotation_rad.size(); }
};

/// The index of the first threshold that `value` does not exceed; the number of thresholds if it
/// exceeds all.
std::size_t first_within(double value, const std::vector<double>& thresholds) {
  return static_cast<std::size_t>(std::lower_bound(thresholds.begin(), thresholds.end(), value) -
                                  thresholds.begin());
}

/// For each curve the number of records within each threshold.
using CountsWithin = std::array<std::vector<int>, kCurves.size()>;

CountsWithin counts_within(const SceneRecords& records, const Thresholds& thresholds) {
  CountsWithin counts;
  // One additional element for records beyond all thresholds.
  for (std::vector<int>& count : counts) count.resize(thresholds.size() + 1);
  for (const TrialRecord* record : records) {
    if (usable_pose(*record) == nullptr || !record->error) continue;
    const std::size_t r = first_within(record->error->rotation_rad, thresholds.rotation_rad);
    const std::size_t t = first_within(record->error->translation_m, thresholds.translation_m);
    ++counts[static_cast<std::size_t>(CurveOf::rotation)][r];
    ++counts[static_cast<std::size_t>(CurveOf::translation)][t];
    ++counts[static_cast<std::size_t>(CurveOf::both)][std::max(r, t)];
  }
  for (std::vector<int>& count : counts) {
    std::partial_sum(count.begin(), count.end(), count.begin());
  }
  return counts;
}

/// The curves over all `rows` combined; the rows belong to one variant.
std::vector<CurveRow> curves_of(const Rows& rows, const std::string& sensor,
                                const RecordGroups& groups, const Thresholds& thresholds) {
  std::array<std::vector<SceneCounts>, kCurves.size()> counts;
  for (std::vector<SceneCounts>& count : counts) count.resize(thresholds.size());
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) {
      if (lacks_truth(scene)) continue;
      const SceneRecords& records = groups.of(row->variant, row->sensor, scene.scene);
      const CountsWithin within = counts_within(records, thresholds);
      for (std::size_t of = 0; of < kCurves.size(); ++of) {
        for (std::size_t i = 0; i < thresholds.size(); ++i) {
          counts[of][i].add(scene.scene, within[of][i], static_cast<int>(records.size()));
        }
      }
    }
  }
  std::vector<CurveRow> curves;
  for (const CurveOf of : kCurves) {
    CurveRow& curve = curves.emplace_back(CurveRow{rows.front()->variant, sensor, of, {}});
    for (const SceneCounts& count : counts[static_cast<std::size_t>(of)]) {
      curve.shares.push_back(count.share());
    }
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
  const Thresholds thresholds(curve.thresholds);
  for (const std::string& variant : variants_of(summary)) {
    Rows with_truth;
    const auto add = [&](const Rows& rows, const std::string& sensor) {
      const auto curves = curves_of(rows, sensor, groups, thresholds);
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
