#include "experiments/report/kind_summary.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "experiments/report/scene_summary.hpp"

namespace croon::experiments {

namespace {

/// What is collected for one row.
struct Collected {
  std::set<std::string> scenes;
  Reference reference = Reference::none;
  Outcomes outcomes;
  int agreeing = 0;
  std::vector<Measures> deviations;
};

/// The rows of one variant and kind.
struct KindRows {
  std::vector<std::string> sensors;  ///< In the order of the summary.
  std::map<std::string, Collected> by_sensor;
  Collected all;
};

void add_scene(Collected& to, const SceneSummary& scene, Reference reference) {
  to.scenes.insert(scene.scene);
  to.reference = std::min(to.reference, reference);
  to.agreeing += scene.agreement.count;
  add_outcomes(to.outcomes, scene.outcomes);
  to.deviations.insert(to.deviations.end(), scene.deviations.begin(), scene.deviations.end());
}

KindSummary summed_up(const std::string& variant, const std::string& kind,
                      const std::string& sensor, const Collected& from) {
  KindSummary row;
  row.variant = variant;
  row.kind = kind;
  row.sensor = sensor;
  row.reference = from.reference;
  row.scenes = static_cast<int>(from.scenes.size());
  row.outcomes = from.outcomes;
  row.success = share_of(from.outcomes.success, from.outcomes.trials);
  row.agreement = share_of(from.agreeing, from.outcomes.trials);
  row.counted = static_cast<int>(from.deviations.size());
  if (row.counted > 0) row.statistics = statistics_of(from.deviations);
  return row;
}

bool has_kinds(const SummaryRow& row) {
  return std::any_of(row.scenes.begin(), row.scenes.end(),
                     [](const SceneSummary& scene) { return !scene.kind.empty(); });
}

}  // namespace

std::vector<KindSummary> summarise_kinds(const std::vector<SummaryRow>& rows) {
  if (std::none_of(rows.begin(), rows.end(), has_kinds)) return {};
  std::vector<KindSummary> summaries;
  for (auto begin = rows.begin(); begin != rows.end();) {
    const std::string& variant = begin->variant;
    std::map<std::string, KindRows> by_kind;
    for (; begin != rows.end() && begin->variant == variant; ++begin) {
      for (const SceneSummary& scene : begin->scenes) {
        KindRows& to = by_kind[scene.kind];
        if (to.by_sensor.count(begin->sensor) == 0) to.sensors.push_back(begin->sensor);
        add_scene(to.by_sensor[begin->sensor], scene, begin->reference);
        add_scene(to.all, scene, begin->reference);
      }
    }
    for (const auto& [kind, from] : by_kind) {
      for (const std::string& sensor : from.sensors) {
        summaries.push_back(summed_up(variant, kind, sensor, from.by_sensor.at(sensor)));
      }
      summaries.push_back(summed_up(variant, kind, "", from.all));
    }
  }
  return summaries;
}

}  // namespace croon::experiments
