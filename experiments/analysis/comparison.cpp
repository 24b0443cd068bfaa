// Compares variants with the base, trial by trial.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "experiments/analysis/paired_tests.hpp"
#include "experiments/analysis/summary.hpp"

namespace croon::experiments {
namespace {

constexpr double kLevel = 0.05;

/// A variant is below the best if its share of successful trials is smaller by more than this, even
/// if there are too few trials for a significant difference.
constexpr double kLargeDifference = 0.05;

/// The compared numbers of a trial.
struct TrialResult {
  std::optional<Measures> errors;  ///< std::nullopt without a usable result.
  double success = 0.0;            ///< 1 if it succeeded.
};

/// The trials that two variants have in common, paired.
struct PairedTrials {
  Clusters scenes;  ///< The scene index of each pair.
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
  return {measures_of(error), is_success ? 1.0 : 0.0};
}

/// The trials of `rows`, which are of one variant, that the base also has. If any scene of a sensor
/// has ground truth, scenes without it are not counted. `base` are all rows of the base; scenes are
/// numbered in the order of these rows.
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
  const TrialSummary all = pooled_counts(scenes_of(rows));
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) {
      if (!is_judged_as(all, scene)) continue;
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

/// The numbers `of` the trials of both sides.
template <class Number>
Pairs pairs_of(const PairedTrials& trials, const Number& of) {
  Pairs pairs;
  for (const TrialResult& result : trials.base) pairs.base.push_back(of(result));
  for (const TrialResult& result : trials.variant) pairs.variant.push_back(of(result));
  return pairs;
}

/// The absolute errors in `measure`; infinite for a trial without a usable result.
ErrorComparison compared_errors(const PairedTrials& trials, std::size_t measure) {
  const Pairs pairs = pairs_of(trials, [measure](const TrialResult& result) {
    return result.errors ? std::abs((*result.errors)[measure])
                         : std::numeric_limits<double>::infinity();
  });
  const Clusters& scenes = trials.scenes;
  ErrorComparison comparison;
  comparison.base_median = median_with_failures(pairs.base);
  comparison.variant_median = median_with_failures(pairs.variant);
  comparison.difference = difference(comparison.variant_median, comparison.base_median);
  const std::vector<double> paired = differences(pairs);
  comparison.paired_difference = median_with_failures(paired);
  if (std::set<std::size_t>(scenes.begin(), scenes.end()).size() >= kMinScenes) {
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

/// Compares only success, not errors.
Comparison compared_success(const PairedTrials& trials) {
  Comparison comparison;
  // 1 if only the variant succeeded, -1 if only the base did, else 0.
  const auto success = [](const TrialResult& result) { return result.success; };
  const std::vector<double> wins = differences(pairs_of(trials, success));
  const auto count = [&](double outcome) {
    return static_cast<int>(std::count(wins.begin(), wins.end(), outcome));
  };
  comparison.only_base = count(-1.0);
  comparison.only_variant = count(1.0);
  comparison.success.favours_variant = comparison.only_variant > comparison.only_base;
  comparison.success.p = mcnemar_p(comparison.only_base, comparison.only_variant);
  comparison.success.p_by_scene = sign_flip_p(cluster_sums(wins, trials.scenes));
  return comparison;
}

/// The numbers of compared trials and scenes.
ComparedTrials counts_of(const PairedTrials& trials) {
  const std::set<std::size_t> scenes(trials.scenes.begin(), trials.scenes.end());
  return {{}, {}, {}, static_cast<int>(trials.scenes.size()), static_cast<int>(scenes.size())};
}

void correct(const std::vector<PairedTest*>& family, double PairedTest::*p,
             double PairedTest::*p_holm) {
  std::vector<double> p_values;
  for (const PairedTest* test : family) p_values.push_back(test->*p);
  const std::vector<double> corrected = holm(p_values);
  for (std::size_t i = 0; i < family.size(); ++i) family[i]->*p_holm = corrected[i];
}

/// Collects the tests of each sensor, which are corrected together.
class TestFamilies {
 public:
  void add(const std::string& sensor, PairedTest& test) { families_[sensor].push_back(&test); }

  void correct_all() const {
    for (const auto& [sensor, family] : families_) {
      correct(family, &PairedTest::p, &PairedTest::p_holm);
      correct(family, &PairedTest::p_by_scene, &PairedTest::p_by_scene_holm);
    }
  }

 private:
  std::map<std::string, std::vector<PairedTest*>> families_;
};

/// The success of all `rows`, or their agreement without ground truth.
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

bool is_significant_by_scene(const PairedTest& test) {
  return is_significant(test) && test.p_by_scene_holm < kLevel;
}

void compare_with_base(const std::string& base, Summary& summary, const RecordGroups& groups,
                       const PoseBounds& bounds) {
  const Rows base_rows = rows_of(summary, base);
  if (base_rows.empty()) return;
  for (const std::string& variant : variants_of(summary)) {
    if (variant == base) continue;
    std::vector<std::string> sensors;
    for (const SummaryRow* row : rows_of(summary, variant)) sensors.push_back(row->sensor);
    sensors.emplace_back();  // All sensors together.
    for (const std::string& sensor : sensors) {
      const auto trials = paired(base_rows, rows_of(summary, variant, sensor), groups, bounds);
      if (trials.scenes.empty()) continue;
      ComparedTrials of = counts_of(trials);
      of.variant = variant;
      of.base = base;
      of.sensor = sensor;
      Comparison& comparison = summary.comparisons.emplace_back(compared_success(trials));
      static_cast<ComparedTrials&>(comparison) = of;
      comparison.rotation_deg = compared_errors(trials, kRotation);
      comparison.translation_m = compared_errors(trials, kTranslation);
      for (std::size_t dof = 0; dof < kDofs; ++dof) {
        summary.dof_comparisons.push_back({of, dof, compared_errors(trials, dof)});
      }
    }
  }
  TestFamilies all, by_dof;
  for (Comparison& of : summary.comparisons) {
    for (PairedTest* test : {&of.rotation_deg.test, &of.translation_m.test, &of.success}) {
      all.add(of.sensor, *test);
    }
  }
  for (DofComparison& of : summary.dof_comparisons) by_dof.add(of.sensor, of.error.test);
  all.correct_all();
  by_dof.correct_all();
}

std::set<VariantSensor> below_best(const Summary& summary, const RecordGroups& groups,
                                   const PoseBounds& bounds) {
  std::set<VariantSensor> below;
  std::vector<std::string> sensors = sensors_of(summary);
  sensors.emplace_back();  // All sensors together.
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
