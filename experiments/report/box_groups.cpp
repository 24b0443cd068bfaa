#include "experiments/report/box_groups.hpp"

#include <algorithm>
#include <set>

namespace croon::experiments {

namespace {

/// The place of `name` in `names`, where it is put if it is new.
std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

std::vector<Measures> all_deviations(const SummaryRow& row) {
  std::vector<Measures> deviations;
  for (const SceneSummary& scene : row.scenes) {
    deviations.insert(deviations.end(), scene.deviations.begin(), scene.deviations.end());
  }
  return deviations;
}

}  // namespace

std::vector<BoxGroup> box_groups(const Summary& summary, std::size_t max_scenes) {
  std::set<std::string> variants;
  std::size_t scenes = 0;
  for (const SummaryRow& row : summary.rows) {
    variants.insert(row.variant);
    scenes = std::max(scenes, row.scenes.size());
  }
  const bool by_variant = variants.size() > 1;
  const bool by_scene = !by_variant && scenes > 1 && scenes <= max_scenes;
  std::vector<std::string> labels;
  std::vector<std::string> sensors;
  std::vector<BoxGroup> groups;
  for (const SummaryRow& row : summary.rows) {
    const std::size_t place = place_of(sensors, row.sensor);
    if (place == groups.size()) groups.push_back({row.sensor, {}});
    std::vector<BoxSeries>& boxes = groups[place].boxes;
    if (by_scene) {
      for (const SceneSummary& scene : row.scenes) {
        boxes.push_back({scene.scene, place_of(labels, scene.scene), scene.deviations});
      }
    } else {
      const std::string label = by_variant ? row.variant : "";
      boxes.push_back({label, place_of(labels, label), all_deviations(row)});
    }
  }
  for (BoxGroup& group : groups) {
    group.boxes.erase(std::remove_if(group.boxes.begin(), group.boxes.end(),
                                     [](const BoxSeries& box) { return box.deviations.empty(); }),
                      group.boxes.end());
  }
  return groups;
}

}  // namespace croon::experiments
