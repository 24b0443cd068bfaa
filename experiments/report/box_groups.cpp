#include "experiments/report/box_groups.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace croon::experiments {

namespace {

/// The place of `name` in `names`, where it is put if it is new.
std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

/// What the deviations of `scene` are gathered under.
std::string label_of(const SummaryRow& row, const SceneSummary& scene, BoxOf of) {
  switch (of) {
    case BoxOf::variant:
      return row.variant;
    case BoxOf::scene:
      return scene.scene;
    case BoxOf::kind:
      return scene.kind;
    case BoxOf::all_scenes:
      return "";
  }
  throw std::logic_error("a box of nothing that exists");
}

}  // namespace

BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds) {
  std::set<std::string> kinds;
  std::size_t scenes = 0;
  for (const SummaryRow& row : summary.rows) {
    scenes = std::max(scenes, row.scenes.size());
  }
  for (const KindSummary& kind : summary.kinds) kinds.insert(kind.kind);
  if (variants_of(summary).size() > 1) return BoxOf::variant;
  if (scenes > 1 && scenes <= max_scenes) return BoxOf::scene;
  const bool by_kind = scenes > 1 && !kinds.empty() && kinds.size() <= max_kinds;
  return by_kind ? BoxOf::kind : BoxOf::all_scenes;
}

std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of) {
  // Kinds come in the order of their summaries, all else in that of the rows.
  std::vector<std::string> labels, sensors;
  if (of == BoxOf::kind) {
    for (const KindSummary& kind : summary.kinds) place_of(labels, kind.kind);
  }
  std::vector<std::map<std::size_t, std::vector<Measures>>> boxes;
  for (const SummaryRow& row : summary.rows) {
    const std::size_t sensor = place_of(sensors, row.sensor);
    boxes.resize(sensors.size());
    for (const SceneSummary& scene : row.scenes) {
      std::vector<Measures>& box = boxes[sensor][place_of(labels, label_of(row, scene, of))];
      box.insert(box.end(), scene.deviations.begin(), scene.deviations.end());
    }
  }
  std::vector<BoxGroup> groups;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    groups.push_back({sensors[i], {}});
    for (const auto& [label, deviations] : boxes[i]) {
      groups[i].boxes.push_back({labels[label], label, deviations});
    }
  }
  return groups;
}

}  // namespace croon::experiments
