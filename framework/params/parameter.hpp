#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace croon::params {

/// The closed interval that a number must lie in.
struct Range {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

enum class ParameterType {
  boolean,
  integer,
  number,
  text,
  choice,
  numbers,
  choices,
  stage,
  stages
};

/// All that there is to know of one parameter: reading, help, JSON Schema and the reference page
/// come from it.
struct ParameterDoc {
  std::string key;
  ParameterType type = ParameterType::number;
  std::string default_json;          ///< JSON text of the default.
  Range range;                       ///< integer, number, numbers.
  std::vector<std::string> choices;  ///< choice, choices.
  std::string stage_kind;            ///< stage, stages.
  std::string sentence;              ///< What it does; one sentence with its full stop.
  bool is_required = false;          ///< The key must be there; `default_json` is then no value.
};

}  // namespace croon::params
