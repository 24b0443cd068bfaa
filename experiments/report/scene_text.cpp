#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "experiments/report/renderers.hpp"
#include "experiments/report/run_text.hpp"

namespace croon::experiments {

namespace {

/// Adds a column to both, with a title that may be any text, also the name of another column.
template <class Row, class F>
void add_titled(View& view, Columns<Row>& columns, const std::string& title, int decimals,
                F value) {
  const std::string name = "column " + std::to_string(columns.columns().size());
  columns.add({name, "", "", decimals}, value);
  view.columns.push_back({title, "<" + name + ">"});
}

/// Success of one variant in one scene, by sensor.
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
  std::map<std::pair<std::string, std::string>, std::size_t> indices;
  for (const SummaryRow& row : summary.rows) {
    for (const SceneSummary& scene : row.scenes) {
      const auto [entry, is_new] = indices.insert({{row.variant, scene.scene}, rows.size()});
      if (is_new) rows.push_back({row.variant, scene.scene, {}});
      rows[entry->second].by_sensor[row.sensor] = &main_share(scene);
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

std::string scene_kind_text(const Summary& summary, const TableStyle& style) {
  using Percents = std::map<std::string, double>;  // By sensor.
  std::vector<std::pair<const SceneKindSummary*, Percents>> rows;
  Percents percents;
  for (const SceneKindSummary& kind : summary.scene_kinds) {
    percents[kind.sensor] = 100.0 * main_share(kind).ratio;
    // The row over all sensors is the last of its kind.
    if (kind.sensor.empty()) rows.emplace_back(&kind, std::exchange(percents, {}));
  }
  using Row = decltype(rows)::value_type;
  Columns<Row> columns;
  columns.add({"variant"}, [](const Row& row) { return row.first->variant; })
      .add({"kind"}, [](const Row& row) { return nothing_if_empty(row.first->scene_kind); })
      .add({"scenes"}, [](const Row& row) { return row.first->scenes; })
      .add({"trials"}, [](const Row& row) { return row.first->outcomes.trials; });
  View view{{{"kind"}, {"scenes"}, {"trials"}}};
  const auto add = [&](const std::string& title, const std::string& sensor) {
    add_titled(view, columns, title, 1, [sensor](const Row& row) {
      const auto found = row.second.find(sensor);
      return found == row.second.end() ? std::nullopt : std::optional<double>(found->second);
    });
  };
  add("all", "");
  for (const std::string& sensor : sensors_of(summary)) add(sensor, sensor);
  return text_table(columns.table(rows), view_by_variant(view, variants_of(summary)),
                    style.colours);
}

std::string scene_text(const Summary& summary, const TableStyle& style) {
  std::vector<SceneRow> rows = scene_rows(summary);
  const std::size_t total = rows.size();
  keep_worst(rows, style.max_scenes);
  Columns<SceneRow> columns;
  columns.add({"variant"}, &SceneRow::variant).add({"scene"}, &SceneRow::scene);
  View view{{{"scene"}}};
  for (const std::string& sensor : sensors_of(summary)) {
    add_titled(view, columns, sensor, 0, [sensor](const SceneRow& row) {
      const auto share = row.by_sensor.find(sensor);
      return share == row.by_sensor.end()
                 ? std::nullopt
                 : std::optional<std::string>(std::to_string(share->second->count) + "/" +
                                              std::to_string(share->second->trials));
    });
  }
  std::string text =
      text_table(columns.table(rows), view_by_variant(view, variants_of(summary)), style.colours);
  if (rows.size() < total) {
    text += "the worst " + std::to_string(rows.size()) + " of " + std::to_string(total) + " rows\n";
  }
  return text;
}

}  // namespace croon::experiments
