#include "experiments/analysis/comparison.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "experiments/analysis/paired_tests.hpp"
#include "experiments/analysis/paired_trials.hpp"

namespace croon::experiments {

namespace {

constexpr double kLevel = 0.05;

/// The base's side of every comparison.
struct BaseTrials {
  std::map<std::string, std::size_t> scene_numbers;
  std::map<std::pair<std::string, std::string>, SceneTrials> by_sensor_and_scene;
};

BaseTrials trials_of_base(const std::string& base, const RecordGroups& groups,
                          const std::vector<SummaryRow>& rows) {
  BaseTrials trials;
  for (const SummaryRow& row : rows) {
    if (row.variant != base) continue;
    for (const SceneSummary& scene : row.scenes) {
      trials.scene_numbers.emplace(scene.scene, trials.scene_numbers.size());
      trials.by_sensor_and_scene.emplace(
          std::pair(row.sensor, scene.scene),
          SceneTrials{groups.at({base, row.sensor, scene.scene}), scene});
    }
  }
  return trials;
}

PairedTrials paired_with(const BaseTrials& base, const SummaryRow& row, const RecordGroups& groups,
                         const PoseBounds& bounds) {
  PairedTrials pairs;
  for (const SceneSummary& scene : row.scenes) {
    const auto other = base.by_sensor_and_scene.find({row.sensor, scene.scene});
    if (other == base.by_sensor_and_scene.end()) continue;
    const SceneTrials variant = {groups.at({row.variant, row.sensor, scene.scene}), scene};
    add_pairs(pairs, base.scene_numbers.at(scene.scene), other->second, variant, bounds);
  }
  return pairs;
}

ErrorComparison compared(const Pairs& pairs, const std::vector<std::size_t>& scenes) {
  ErrorComparison comparison;
  comparison.base_median = median_with_failures(pairs.base);
  comparison.variant_median = median_with_failures(pairs.variant);
  comparison.difference = difference(comparison.variant_median, comparison.base_median);
  comparison.interval = median_difference_interval(pairs, scenes);
  const std::vector<double> ranks = signed_ranks(differences(pairs));
  // Smaller errors are better.
  comparison.test.favours_variant = std::accumulate(ranks.begin(), ranks.end(), 0.0) < 0.0;
  comparison.test.p = wilcoxon_p(ranks);
  comparison.test.p_by_scene = sign_flip_p(cluster_sums(ranks, scenes));
  return comparison;
}

Comparison compared(const PairedTrials& trials) {
  Comparison comparison;
  const auto count = [&](double outcome) {
    return static_cast<int>(std::count(trials.success.begin(), trials.success.end(), outcome));
  };
  comparison.pairs = static_cast<int>(trials.scenes.size());
  comparison.scenes =
      static_cast<int>(std::set<std::size_t>(trials.scenes.begin(), trials.scenes.end()).size());
  comparison.only_base = count(-1.0);
  comparison.only_variant = count(1.0);
  comparison.rotation_deg = compared(trials.rotation_deg, trials.scenes);
  comparison.translation_m = compared(trials.translation_m, trials.scenes);
  comparison.success.favours_variant = comparison.only_variant > comparison.only_base;
  comparison.success.p = mcnemar_p(comparison.only_base, comparison.only_variant);
  comparison.success.p_by_scene = sign_flip_p(cluster_sums(trials.success, trials.scenes));
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
    std::vector<PairedTest*>& family = families[comparison.sensor];
    family.push_back(&comparison.rotation_deg.test);
    family.push_back(&comparison.translation_m.test);
    family.push_back(&comparison.success);
  }
  for (const auto& [sensor, family] : families) {
    correct(family, &PairedTest::p, &PairedTest::p_holm);
    correct(family, &PairedTest::p_by_scene, &PairedTest::p_by_scene_holm);
  }
}

}  // namespace

bool is_significant(const PairedTest& test) { return test.p_holm < kLevel; }

bool holds_by_scene(const PairedTest& test) {
  return is_significant(test) && test.p_by_scene_holm < kLevel;
}

std::vector<Comparison> compare_with_base(const std::string& base, const RecordGroups& groups,
                                          const std::vector<SummaryRow>& rows,
                                          const SuccessBounds& bounds) {
  const BaseTrials base_trials = trials_of_base(base, groups, rows);
  std::vector<Comparison> comparisons;
  const auto add = [&](const std::string& variant, const std::string& sensor,
                       const PairedTrials& trials) {
    if (trials.scenes.empty()) return;
    comparisons.push_back(compared(trials));
    comparisons.back().variant = variant;
    comparisons.back().base = base;
    comparisons.back().sensor = sensor;
  };
  for (auto row = rows.begin(); row != rows.end();) {
    const std::string& variant = row->variant;
    PairedTrials all;
    for (; row != rows.end() && row->variant == variant; ++row) {
      if (variant == base) continue;
      const PairedTrials trials = paired_with(base_trials, *row, groups, pose_bounds(bounds));
      add(variant, row->sensor, trials);
      append(all, trials);
    }
    add(variant, "", all);
  }
  correct_by_sensor(comparisons);
  return comparisons;
}

}  // namespace croon::experiments
