#include "experiments/file/grid.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/file/names.hpp"
#include "framework/params/values.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using params::Node;

/// The name of the stage that `value` describes; empty where it describes none.
std::string type_of(const json& value) {
  for (const char* key : {"type", "step"}) {
    if (value.is_object() && value.contains(key) && value.at(key).is_string()) {
      return value.at(key).get<std::string>();
    }
  }
  return "";
}

/// A value as a part of a variant's name: what may not stand in one becomes `_`.
std::string text_of(const json& value) {
  std::string text = type_of(value);
  if (value.is_string()) text = value.get<std::string>();
  if (value.is_number()) text = params::value_json(value.get<double>());
  if (value.is_array()) {
    for (const json& element : value) text += (text.empty() ? "" : "+") + text_of(element);
  }
  if (text.empty()) text = value.dump();
  for (char& c : text) {
    if (!kVariantName.allows({'x', c, 'x'})) c = '_';
  }
  return text;
}

/// The keys in which stages of the type of `value` differ on this axis.
std::vector<std::string> differing_keys(const json& values, const json& value) {
  std::vector<std::string> keys;
  for (const json& other : values) {
    if (type_of(other) != type_of(value)) continue;
    for (const auto& item : other.items()) {
      const bool differs = std::any_of(values.begin(), values.end(), [&](const json& third) {
        return type_of(third) == type_of(value) && third.value(item.key(), json()) != item.value();
      });
      const bool is_new = std::find(keys.begin(), keys.end(), item.key()) == keys.end();
      if (differs && is_new) keys.push_back(item.key());
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::string label_of(const std::string& key, const json& values, const json& value) {
  const std::string type = type_of(value);
  if (type.empty()) return key + "=" + text_of(value);
  std::string parameters;
  for (const std::string& differing : differing_keys(values, value)) {
    if (!value.contains(differing)) continue;
    parameters += (parameters.empty() ? "" : " ") + differing + "=" + text_of(value[differing]);
  }
  return text_of(type) + (parameters.empty() ? "" : "(" + parameters + ")");
}

std::string last_key(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// The shortest key that no other axis has.
std::string axis_key(const json& grid, const std::string& path) {
  int axes = 0;
  for (const auto& [other, values] : grid.items()) axes += last_key(other) == last_key(path);
  return axes == 1 ? last_key(path) : path;
}

}  // namespace

std::vector<GridAxis> read_grid(const Node& grid) {
  std::vector<GridAxis> axes;
  if (!grid.is_object()) return axes;
  for (const auto& [path, values] : grid.value().items()) {
    GridAxis axis{path, grid.member(path), {}};
    if (!axis.node.is_array()) continue;
    if (values.empty()) axis.node.expected("a list of at least one value");
    for (std::size_t i = 0; i < values.size(); ++i) {
      GridPoint point{label_of(axis_key(grid.value(), path), values, values[i]),
                      axis.node.element(i)};
      if (std::find(values.begin(), values.begin() + i, values[i]) != values.begin() + i) {
        point.value.fault("\"" + point.label + "\" stands in this list twice");
      }
      const auto is_same = [&](const GridPoint& other) { return other.label == point.label; };
      // Lists of stages may differ in what a label does not show. Then the index is added.
      if (std::any_of(axis.points.begin(), axis.points.end(), is_same)) {
        point.label += " (" + std::to_string(i + 1) + ")";
      }
      axis.points.push_back(point);
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

}  // namespace croon::experiments
