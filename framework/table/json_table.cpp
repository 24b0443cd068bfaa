#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon {

namespace {

using Json = nlohmann::ordered_json;

struct ValueJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(double value) const {
    return std::isfinite(value) ? Json(value) : Json(shortest_number(value));
  }
  template <class T>
  Json operator()(const T& value) const {
    return value;
  }
};

/// Replaces objects and lists that contain only nulls by null.
void collapse(Json& json) {
  if (!json.is_structured()) return;
  for (Json& member : json) collapse(member);
  const auto is_null = [](const Json& member) { return member.is_null(); };
  if (std::all_of(json.begin(), json.end(), is_null)) json = nullptr;
}

/// Lists the best and the marked cells of a row.
void add_ranks(Json& json, const Table& table, const CellRow& row) {
  Json best = Json::array();
  Json marks = Json::object();
  for (std::size_t k = 0; k < row.size(); ++k) {
    const std::string name = table.columns[k].full_name();
    if (row[k].is_best) best.push_back(name);
    if (!row[k].mark.empty()) marks[name] = row[k].mark;
  }
  json["best"] = std::move(best);
  json["marks"] = std::move(marks);
}

}  // namespace

Json json_rows(const Table& table) {
  std::vector<Json::json_pointer> paths;
  for (const Column& column : table.columns) {
    paths.emplace_back(column.path.empty() ? "/" + column.full_name() : column.path);
  }
  const bool is_ranked = std::any_of(table.columns.begin(), table.columns.end(),
                                     [](const Column& column) { return column.has_marks; });
  Json rows = Json::array();
  for (const CellRow& row : table.rows) {
    Json json = Json::object();
    for (std::size_t k = 0; k < row.size(); ++k) {
      json[paths[k]] = std::visit(ValueJson(), row[k].value);
    }
    for (Json& member : json) collapse(member);
    if (is_ranked) add_ranks(json, table, row);
    rows.push_back(std::move(json));
  }
  return rows;
}

std::string json_bytes(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace croon
