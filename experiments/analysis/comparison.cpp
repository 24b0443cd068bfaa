// Variants against the base, trial by trial.
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "experiments/analysis/paired_tests.hpp"
#include "experiments/analysis/summary.hpp"
#include "framework/base/angles.hpp"

namespace croon::experiments {
namespace {

constexpr double kLevel = 0.05;

/// A variant that succeeds in so many trials less, as a share of all, is below the best even if too
/// few trials were run for a significant difference.
constexpr double kLargeDifference = 0.05;

/// The numbers of a trial that are compared; errors are infinite if it has no usable result.
struct TrialResult {
  double rotation_deg = std::numeric_limits<double>::infinity();
  double translation_m = std::numeric_limits<double>::infinity();
  double success = 0.0;  ///< 1 if it succeeded.
};

/// The trials that both of two variants have, pair by pair.
struct PairedTrials {
  Clusters scenes;  ///< The index of each pair's scene.
  std::vector<TrialResult> base;
  std::vector<TrialResult> variant;
};

TrialResult result_of(const TrialRecord& record, const SceneSummary& scene,
                      const PoseBounds& bounds) {
  const RigidTransform* const pose = usable_pose(record);
  if (pose == nullptr || (!record.error && !scene.consensus)) return {};
  const PoseError error = record.error ? *record.error : pose_error(*pose, *scene.consensus);
  const bool is_success = record.error ? record.status == Status::success
                                       : agrees(record, scene, bounds).value_or(false);
  return {deg_from_rad(error.rotation_rad), error.translation_m, is_success ? 1.0 : 0.0};
}

/// The trials of `rows`, which are of one variant, that the base has too. `base` are all rows of
/// the base: scenes are numbered as they come in them.
PairedTrials paired(const Rows& base, const Rows& rows, const RecordGroups& groups,
                    const PoseBounds& bounds) {
  std::map<std::string, std::size_t> numbers;
  std::map<std::pair<std::string, std::string>, const SceneSummary*> base_scenes;
  for (const SummaryRow* row : base) {
    for (const SceneSummary& scene : row->scenes) {
      numbers.emplace(scene.scene, numbers.size());
      base_scenes[{row->sensor, scene.scene}] = &scene;
    }
  }
  PairedTrials pairs;
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) {
      const auto& base_records = groups.of(base.front()->variant, row->sensor, scene.scene);
      for (const TrialRecord* record : groups.of(row->variant, row->sensor, scene.scene)) {
        const TrialRecord* const other = find_trial(base_records, record->id.trial);
        if (other == nullptr) continue;
        const SceneSummary& base_scene = *base_scenes.at({row->sensor, scene.scene});
        pairs.scenes.push_back(numbers.at(scene.scene));
        pairs.base.push_back(result_of(*other, base_scene, bounds));
        pairs.variant.push_back(result_of(*record, scene, bounds));
      }
    }
  }
  return pairs;
}

/// One number of each pair of trials.
Pairs pairs_of(const PairedTrials& trials, double TrialResult::*number) {
  Pairs pairs;
  for (const TrialResult& result : trials.base) pairs.base.push_back(result.*number);
  for (const TrialResult& result : trials.variant) pairs.variant.push_back(result.*number);
  return pairs;
}

ErrorComparison compared(const Pairs& pairs, const Clusters& scenes) {
  ErrorComparison comparison;
  comparison.base_median = median_with_failures(pairs.base);
  comparison.variant_median = median_with_failures(pairs.variant);
  comparison.difference = difference(comparison.variant_median, comparison.base_median);
  const std::vector<double> paired = differences(pairs);
  comparison.paired_difference = median_with_failures(paired);
  if (std::set<std::size_t>(scenes.begin(), scenes.end()).size() >= kLeastScenes) {
    comparison.interval = median_difference_interval(pairs, scenes);
    const std::vector<double> zeros(paired.size(), 0.0);
    comparison.paired_interval = median_difference_interval({zeros, paired}, scenes);
  }
  const std::vector<double> ranks = signed_ranks(paired);
  // Smaller errors are better.
  comparison.test.favours_variant = std::accumulate(ranks.begin(), ranks.end(), 0.0) < 0.0;
  comparison.test.p = wilcoxon_p(ranks);
  comparison.test.p_by_scene = sign_flip_p(cluster_sums(ranks, scenes));
  return comparison;
}

/// Success alone, without errors.
Comparison compared_success(const PairedTrials& trials) {
  Comparison comparison;
  // 1 if the variant alone won, -1 if the base did, else 0.
  const std::vector<double> wins = differences(pairs_of(trials, &TrialResult::success));
  const auto count = [&](double outcome) {
    return static_cast<int>(std::count(wins.begin(), wins.end(), outcome));
  };
  comparison.pairs = static_cast<int>(trials.scenes.size());
  comparison.scenes =
      static_cast<int>(std::set<std::size_t>(trials.scenes.begin(), trials.scenes.end()).size());
  comparison.only_base = count(-1.0);
  comparison.only_variant = count(1.0);
  comparison.success.favours_variant = comparison.only_variant > comparison.only_base;
  comparison.success.p = mcnemar_p(comparison.only_base, comparison.only_variant);
  comparison.success.p_by_scene = sign_flip_p(cluster_sums(wins, trials.scenes));
  return comparison;
}

Comparison compared(const PairedTrials& trials) {
  Comparison comparison = compared_success(trials);
  comparison.rotation_deg = compared(pairs_of(trials, &TrialResult::rotation_deg), trials.scenes);
  comparison.translation_m = compared(pairs_of(trials, &TrialResult::translation_m), trials.scenes);
  return comparison;
}

void correct(const std::vector<PairedTest*>& family, double PairedTest::*p,
             double PairedTest::*p_holm) {
  std::vector<double> p_values;
  for (const PairedTest* test : family) p_values.push_back(test->*p);
  const std::vector<double> corrected = holm(p_values);
  for (std::size_t i = 0; i < family.size(); ++i) family[i]->*p_holm = corrected[i];
}

void correct_by_sensor(std::vector<Comparison>& comparisons) {
  std::map<std::string, std::vector<PairedTest*>> families;
  for (Comparison& comparison : comparisons) {
    for (PairedTest* test :
         {&comparison.rotation_deg.test, &comparison.translation_m.test, &comparison.success}) {
      families[comparison.sensor].push_back(test);
    }
  }
  for (const auto& [sensor, family] : families) {
    correct(family, &PairedTest::p, &PairedTest::p_holm);
    correct(family, &PairedTest::p_by_scene, &PairedTest::p_by_scene_holm);
  }
}

/// The share that counts, of all `rows`.
double success_ratio(const Rows& rows) { return main_share(pooled_counts(scenes_of(rows))).ratio; }

bool is_below(const Rows& best, const Rows& rows, const RecordGroups& groups,
              const PoseBounds& bounds) {
  const double difference = success_ratio(best) - success_ratio(rows);
  if (difference <= 0.0) return false;
  constexpr double kRounding = 1e-9;
  if (difference > kLargeDifference + kRounding) return true;
  const PairedTrials trials = paired(best, rows, groups, bounds);
  if (trials.scenes.empty()) return false;
  const Comparison comparison = compared_success(trials);
  return comparison.only_base > comparison.only_variant && comparison.success.p < kLevel;
}

}  // namespace

bool is_significant(const PairedTest& test) { return test.p_holm < kLevel; }

bool holds_by_scene(const PairedTest& test) {
  return is_significant(test) && test.p_by_scene_holm < kLevel;
}

std::vector<Comparison> compare_with_base(const std::string& base, const Summary& summary,
                                          const RecordGroups& groups, const PoseBounds& bounds) {
  std::vector<Comparison> comparisons;
  const Rows base_rows = rows_of(summary, base);
  if (base_rows.empty()) return comparisons;
  for (const std::string& variant : variants_of(summary)) {
    if (variant == base) continue;
    std::vector<std::string> sensors;
    for (const SummaryRow* row : rows_of(summary, variant)) sensors.push_back(row->sensor);
    sensors.emplace_back();  // All together.
    for (const std::string& sensor : sensors) {
      const auto trials = paired(base_rows, rows_of(summary, variant, sensor), groups, bounds);
      if (trials.scenes.empty()) continue;
      Comparison& comparison = comparisons.emplace_back(compared(trials));
      comparison.variant = variant;
      comparison.base = base;
      comparison.sensor = sensor;
    }
  }
  correct_by_sensor(comparisons);
  return comparisons;
}

std::set<VariantSensor> below_best(const Summary& summary, const RecordGroups& groups,
                                   const PoseBounds& bounds) {
  std::set<VariantSensor> below;
  std::vector<std::string> sensors = sensors_of(summary);
  sensors.emplace_back();  // All together.
  const std::vector<std::string> variants = variants_of(summary);
  for (const std::string& sensor : sensors) {
    Rows best;
    for (const std::string& variant : variants) {
      const Rows rows = rows_of(summary, variant, sensor);
      if (rows.empty()) continue;
      if (best.empty() || success_ratio(rows) > success_ratio(best)) best = rows;
    }
    for (const std::string& variant : variants) {
      const Rows rows = rows_of(summary, variant, sensor);
      if (rows.empty() || !is_below(best, rows, groups, bounds)) continue;
      below.insert({variant, sensor});
    }
  }
  return below;
}

}  // namespace croon::experiments
