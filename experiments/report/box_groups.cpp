// The groups of boxes of a figure.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "experiments/report/plots.hpp"
#include "framework/picture/chart.hpp"

namespace croon::experiments {
namespace {

/// The index of `name` in `names`; added if it is new.
std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

/// The label of the box that contains the deviations of `scene`.
std::string label_of(const SummaryRow& row, const SceneSummary& scene, BoxOf of) {
  return of == BoxOf::variant      ? row.variant
         : of == BoxOf::scene      ? scene.scene
         : of == BoxOf::scene_kind ? scene.scene_kind
                                   : "";
}

}  // namespace

BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds) {
  std::set<std::string> kinds;
  std::size_t scenes = 0;
  for (const SummaryRow& row : summary.rows) {
    scenes = std::max(scenes, row.scenes.size());
  }
  for (const SceneKindSummary& kind : summary.scene_kinds) kinds.insert(kind.scene_kind);
  if (variants_of(summary).size() > 1) return BoxOf::variant;
  if (scenes > 1 && scenes <= max_scenes) return BoxOf::scene;
  const bool by_kind = scenes > 1 && !kinds.empty() && kinds.size() <= max_kinds;
  return by_kind ? BoxOf::scene_kind : BoxOf::all_scenes;
}

std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of) {
  // Kinds are in the order of their summaries, everything else in the order of the rows.
  std::vector<std::string> labels, sensors;
  if (of == BoxOf::scene_kind) {
    for (const SceneKindSummary& kind : summary.scene_kinds) index_of(labels, kind.scene_kind);
  }
  std::vector<std::map<std::size_t, BoxSeries>> boxes;
  for (const SummaryRow& row : summary.rows) {
    const std::size_t sensor = index_of(sensors, row.sensor);
    boxes.resize(sensors.size());
    for (const SceneSummary& scene : row.scenes) {
      if (!is_judged_as(row, scene)) continue;
      BoxSeries& box = boxes[sensor][index_of(labels, label_of(row, scene, of))];
      box.deviations.insert(box.deviations.end(), scene.deviations.begin(), scene.deviations.end());
      box.trials += scene.outcomes.trials;
    }
  }
  std::vector<BoxGroup> groups;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    groups.push_back({sensors[i], {}});
    for (auto& [label, box] : boxes[i]) {
      box.label = labels[label];
      box.colour = label;
      groups[i].boxes.push_back(std::move(box));
    }
  }
  return groups;
}

double robust_limit(const std::vector<BoxGroup>& groups, std::size_t measure) {
  constexpr double kWhiskers = 3.0;
  constexpr double kMaxWhiskers = 10.0;
  std::vector<double> reaches;
  double of_sensors = 0.0;  // Keeps the best box of each sensor visible.
  for (const BoxGroup& group : groups) {
    double best = std::numeric_limits<double>::infinity();
    for (const BoxSeries& box : group.boxes) {
      if (box.deviations.empty()) continue;
      const BoxPlot plot = box_plot(values_of(box.deviations, measure));
      reaches.push_back(std::max(std::abs(plot.lower_whisker), std::abs(plot.upper_whisker)));
      best = std::min(best, reaches.back());
    }
    if (std::isfinite(best)) of_sensors = std::max(of_sensors, best);
  }
  const double min_limit = 10.0 * std::pow(10.0, -kMeasures[measure].decimals);
  if (reaches.empty()) return min_limit;
  std::sort(reaches.begin(), reaches.end());
  const double median = reaches[(reaches.size() - 1) / 2];
  return std::max({min_limit, kWhiskers * median, std::min(of_sensors, kMaxWhiskers * median)});
}

void shorten_labels(std::vector<BoxGroup>& groups, std::size_t columns) {
  std::map<std::size_t, std::string> names;  // By series.
  for (const BoxGroup& group : groups) {
    for (const BoxSeries& box : group.boxes) names[box.colour] = box.label;
  }
  std::vector<std::string> labels;
  for (const auto& [series, name] : names) labels.push_back(name);
  labels = distinct_labels(labels, columns);
  std::size_t i = 0;
  for (auto& [series, name] : names) name = labels[i++];
  for (BoxGroup& group : groups) {
    for (BoxSeries& box : group.boxes) box.label = names.at(box.colour);
  }
}

}  // namespace croon::experiments
