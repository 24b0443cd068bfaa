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
  stages,
  group,
  map
};

/// All that there is to know of one parameter: reading, help, JSON Schema and the reference page
/// come from it.
struct ParameterDoc {
  std::string key;
  ParameterType type = ParameterType::number;
  std::string default_json;          ///< JSON text of the default.
  Range range;                       ///< integer, number, numbers.
  std::vector<std::string> choices;  ///< choice, choices; the names of a group's presets.
  std::string stage_kind;            ///< stage, stages.
  std::string sentence;              ///< What it does; one sentence with its full stop.
  bool is_required = false;          ///< The key must be there; `default_json` is then no value.
  std::vector<ParameterDoc> members = {};  ///< group, map: what is in the object, in each object.
  std::vector<std::string> preset_json = {};  ///< group: the object that each preset stands for.
  std::string name_words = "";                ///< map: what its keys are, "a sensor's name".
};

}  // namespace croon::params
