#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/params/node.hpp"
#include "framework/params/parameter.hpp"

namespace croon::params {

/// A number for each of three axes; a single number sets all three.
struct PerAxis {
  std::array<double, 3> values;

  PerAxis(double all) : values{all, all, all} {}  // NOLINT: implicit on purpose.
  double operator[](std::size_t axis) const { return values[axis]; }
  friend bool operator==(const PerAxis& a, const PerAxis& b) { return a.values == b.values; }
};

/// Reads the value of `node` into `out` and checks it against `doc`. If the value is invalid, notes
/// a fault and leaves `out` unchanged.
void read_value(const Node& node, const ParameterDoc& doc, bool& out);
void read_value(const Node& node, const ParameterDoc& doc, int& out);
void read_value(const Node& node, const ParameterDoc& doc, std::uint64_t& out);
void read_value(const Node& node, const ParameterDoc& doc, double& out);
void read_value(const Node& node, const ParameterDoc& doc, std::array<double, 2>& out);
void read_value(const Node& node, const ParameterDoc& doc, PerAxis& out);
void read_value(const Node& node, const ParameterDoc& doc, std::string& out);
void read_value(const Node& node, const ParameterDoc& doc, std::vector<double>& out);
void read_value(const Node& node, const ParameterDoc& doc, std::vector<std::string>& out);

/// The index of the node's word in `words`. If it is not one of them, notes a fault with the
/// nearest one. `or_else` names other values that are allowed: " or an object".
std::optional<std::size_t> read_word(const Node& node, const std::vector<std::string>& words,
                                     const std::string& or_else = "");

/// The indices in `words` of the elements of the list `node`. Notes a fault if the node is not a
/// list or is empty, and for each element that is not in `words` or is a duplicate.
std::vector<std::size_t> read_words(const Node& node, const std::vector<std::string>& words);

/// The JSON text of a value.
std::string value_json(bool value);
std::string value_json(int value);
std::string value_json(std::uint64_t value);
std::string value_json(double value);
std::string value_json(const std::array<double, 2>& ends);
/// A single number if all three are equal.
std::string value_json(const PerAxis& axes);
std::string value_json(const std::string& value);
std::string value_json(const std::vector<double>& value);
std::string value_json(const std::vector<std::string>& value);

/// The JSON text of the node's value.
std::string node_json(const Node& node);

/// Keys, each with the JSON text of its value; no text means no value.
using Members = std::vector<std::pair<std::string, std::string>>;

/// The JSON text of the object with `members`, without keys that the rules exclude.
std::string object_json(const Members& members, const std::vector<KeyRule>& rules = {});

/// The JSON text of the list of `values`, each written by `json`.
template <class T, class Json>
std::string list_json(const std::vector<T>& values, const Json& json) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ",") + json(value);
  return "[" + text + "]";
}

/// Notes a fault for each rule that the object `node` breaks.
void check_key_rules(const Node& node, const std::vector<KeyRule>& rules);

/// Notes that `members` break the rule `message`, and appends the values of the keys that `message`
/// names.
void note_broken_rule(const Node& node, const std::string& message, const Members& members);

/// Sets the parameter's default to the JSON text `value`, or to the name of the preset equal to it.
void set_default(ParameterDoc& doc, const std::string& value);

/// Calls `use` with the parameter's default as a node; notes faults in it at `node`.
void read_default(const ParameterDoc& doc, const Node& node,
                  const std::function<void(const Node&)>& use);

/// Calls `use` with each element of the array `node`.
void for_each_element(const Node& node, const std::function<void(const Node&)>& use);

/// The range in words, e.g. "a number from 0 to 10", "a number of at least 0".
std::string range_words(const std::string& what, const Range& range);

}  // namespace croon::params
