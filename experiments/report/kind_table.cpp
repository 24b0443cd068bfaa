#include <map>

#include "experiments/report/row_table.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

std::string kind_table(const Summary& summary, const TableStyle& style) {
  std::vector<std::string> columns = {"scenes", "trials", "all"};
  const std::vector<std::string> sensors = sensors_of(summary);
  columns.insert(columns.end(), sensors.begin(), sensors.end());
  RowTable table(summary, {"kind"}, columns);
  std::map<std::string, std::string> by_sensor;
  for (const KindSummary& kind : summary.kinds) {
    const std::string percent = fixed_number(100.0 * main_share(kind).ratio, 1);
    if (!kind.sensor.empty()) {
      by_sensor[kind.sensor] = percent;
      continue;
    }
    // The row over all sensors ends its kind.
    std::vector<std::string> cells = {std::to_string(kind.scenes),
                                      std::to_string(kind.outcomes.trials), percent};
    for (const std::string& sensor : sensors) {
      const auto found = by_sensor.find(sensor);
      cells.push_back(found == by_sensor.end() ? "-" : found->second);
    }
    table.add(kind.variant, {kind.kind.empty() ? "-" : kind.kind}, cells);
    by_sensor.clear();
  }
  return table.text(style);
}

}  // namespace croon::experiments
