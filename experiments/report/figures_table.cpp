#include <algorithm>
#include <functional>

#include "experiments/report/cloud_figures.hpp"
#include "experiments/report/csv_row.hpp"
#include "experiments/report/text.hpp"
#include "experiments/report/text_table.hpp"
#include "framework/base/statistics.hpp"

namespace croon::experiments {
namespace {

/// One figure: what it is called, and its value where there is one.
struct Column {
  const char* name;
  int decimals;
  std::function<std::optional<double>(const CloudFigures&)> value;
};

const std::vector<Column>& columns() {
  using Figures = CloudFigures;
  static const std::vector<Column> columns = {
      {"points", 0, [](const Figures& f) { return static_cast<double>(f.points); }},
      {"ground_ratio", 2, [](const Figures& f) { return f.ground_ratio; }},
      {"median_range_m", 1, [](const Figures& f) { return f.median_range_m; }},
      {"occupied_volume_m3", 1, [](const Figures& f) { return f.occupied_volume_m3; }},
      {"median_distance_m", 3, [](const Figures& f) { return f.median_distance_m; }},
      {"overlap_ratio", 2, [](const Figures& f) { return f.overlap_ratio; }}};
  return columns;
}

/// "21.6 (14.0 to 30.2)"; "-" where no cloud has the figure.
std::string cell(const std::vector<const CloudFigures*>& clouds, const Column& column) {
  std::vector<double> values;
  for (const CloudFigures* cloud : clouds) {
    if (const auto value = column.value(*cloud)) values.push_back(*value);
  }
  if (values.empty()) return "-";
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const auto text = [&](double value) { return fixed_number(value, column.decimals); };
  const std::string middle = text(median(values));
  if (values.size() == 1) return middle;
  return middle + " (" + text(*least) + " to " + text(*most) + ")";
}

/// The clouds of each sensor and dataset, sensors in the order in which they come first.
std::vector<std::vector<const CloudFigures*>> grouped(const std::vector<CloudFigures>& figures) {
  std::vector<std::string> sensors, datasets;
  const auto note = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const CloudFigures& cloud : figures) {
    note(sensors, cloud.sensor);
    note(datasets, cloud.dataset);
  }
  std::vector<std::vector<const CloudFigures*>> groups;
  for (const std::string& sensor : sensors) {
    for (const std::string& dataset : datasets) {
      std::vector<const CloudFigures*> group;
      for (const CloudFigures& cloud : figures) {
        if (cloud.sensor == sensor && cloud.dataset == dataset) group.push_back(&cloud);
      }
      if (!group.empty()) groups.push_back(std::move(group));
    }
  }
  return groups;
}

}  // namespace

std::string figures_table(const std::vector<CloudFigures>& figures) {
  std::vector<std::string> header = {"sensor", "dataset"};
  for (const Column& column : columns()) header.push_back(column.name);
  TextTable table(header, 2);
  for (const auto& group : grouped(figures)) {
    std::vector<std::string> cells = {group.front()->sensor, group.front()->dataset};
    for (const Column& column : columns()) cells.push_back(cell(group, column));
    table.add(cells);
  }
  return table.text(false);
}

std::string figures_csv(const std::vector<CloudFigures>& figures) {
  CsvRow header;
  for (const char* name : {"dataset", "scene", "kind", "sensor"}) header.text(name);
  for (const Column& column : columns()) header.text(column.name);
  std::string bytes = header.line();
  for (const CloudFigures& cloud : figures) {
    CsvRow row;
    row.text(cloud.dataset).text(cloud.scene).text(cloud.kind).text(cloud.sensor);
    for (const Column& column : columns()) {
      const auto value = column.value(cloud);
      value ? row.number(*value) : row.empty();
    }
    bytes += row.line();
  }
  return bytes;
}

}  // namespace croon::experiments
