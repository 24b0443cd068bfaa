#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "experiments/report/row_table.hpp"

namespace croon::experiments {

namespace {

/// Success of one variant in one scene, sensor by sensor.
struct SceneRow {
  std::string variant;
  std::string scene;
  std::map<std::string, const Share*> by_sensor;

  /// The least share of all sensors, then their sum: the worst come first.
  std::pair<double, double> worst() const {
    std::pair<double, double> ratio = {std::numeric_limits<double>::infinity(), 0.0};
    for (const auto& [sensor, share] : by_sensor) {
      ratio.first = std::min(ratio.first, share->ratio);
      ratio.second += share->ratio;
    }
    return ratio;
  }
};

std::vector<SceneRow> scene_rows(const Summary& summary) {
  std::vector<SceneRow> rows;
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (const SummaryRow& row : summary.rows) {
    for (const SceneSummary& scene : row.scenes) {
      const auto [entry, is_new] = place.insert({{row.variant, scene.scene}, rows.size()});
      if (is_new) rows.push_back({row.variant, scene.scene, {}});
      rows[entry->second].by_sensor[row.sensor] = &main_share(row, scene);
    }
  }
  return rows;
}

/// Keeps the `count` worst rows, in their order.
void keep_worst(std::vector<SceneRow>& rows, std::size_t count) {
  if (rows.size() <= count) return;
  std::vector<std::pair<std::pair<double, double>, std::size_t>> worst;
  for (std::size_t i = 0; i < rows.size(); ++i) worst.emplace_back(rows[i].worst(), i);
  std::sort(worst.begin(), worst.end());
  worst.resize(count);
  std::sort(worst.begin(), worst.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<SceneRow> kept;
  for (const auto& [ratio, i] : worst) kept.push_back(std::move(rows[i]));
  rows = std::move(kept);
}

}  // namespace

std::string scene_table(const Summary& summary, const TableStyle& style) {
  const std::vector<std::string> sensors = sensors_of(summary);
  std::vector<SceneRow> rows = scene_rows(summary);
  const std::size_t total = rows.size();
  keep_worst(rows, style.max_scenes);
  RowTable table(summary, {"scene"}, sensors);
  for (const SceneRow& row : rows) {
    std::vector<std::string> cells;
    for (const std::string& sensor : sensors) {
      const auto share = row.by_sensor.find(sensor);
      cells.push_back(share == row.by_sensor.end() ? "-" : share_text(*share->second));
    }
    table.add(row.variant, {row.scene}, cells);
  }
  std::string text = table.text(style);
  if (rows.size() < total) {
    text += "the worst " + std::to_string(rows.size()) + " of " + std::to_string(total) + " rows\n";
  }
  return text;
}

}  // namespace croon::experiments
