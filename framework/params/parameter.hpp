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

/// Which names are allowed: letters, digits and `marks`, at least one character, and none of
/// `not_first` (`not_last`) as the first (last) one.
struct NameRule {
  std::string marks;
  std::string words;  ///< What is expected, for messages: "a name of letters, digits, _ and -".
  std::string not_first = {};
  std::string not_last = {};

  bool allows(const std::string& name) const;
  /// The same rule as a regular expression of JSON Schema.
  std::string pattern() const;
};

/// Which keys of one object belong together. The rule applies if the object has `key` and, if
/// `words` are given, the key's value is one of them. Then every key of `required` must be there
/// and none of `excluded` may be. In canonical JSON, excluded keys are left out.
struct KeyRule {
  std::string key;  ///< "file"; "sweep/rotation_deg" is a key of an object in the object.
  std::vector<std::string> words = {};
  bool is_negated = false;  ///< Applies if the key is missing; with words, if the value is another.
  std::vector<std::string> required = {};
  std::vector<std::string> excluded = {};
  std::string expected = {};  ///< Of excluded keys, for messages: "no key beside \"file\"".
  /// If not empty, the rule is another one: exactly one of these keys must be there.
  std::vector<std::string> one_of = {};
};

enum class ParameterType {
  boolean,
  integer,
  number,
  interval,
  per_axis,
  text,
  choice,
  numbers,
  texts,
  choices,
  stage,
  stages,
  group,
  map,
  list,
  json
};

/// All that there is to know of one parameter: reading, help, JSON Schema, canonical JSON and the
/// reference page come from it.
struct ParameterDoc {
  std::string key;
  ParameterType type = ParameterType::number;
  std::string default_json;          ///< JSON text of the default.
  Range range;                       ///< integer, number, numbers, interval, per_axis.
  std::vector<std::string> choices;  ///< choice, choices; the names of a group's presets.
  std::string stage_kind;            ///< stage, stages.
  std::string sentence;              ///< What it does; one sentence with its full stop.
  bool is_required = false;          ///< The key must be there; `default_json` is then no value.
  bool is_optional = false;          ///< The key may be missing, and has no default.
  std::vector<ParameterDoc> members = {};     ///< group, map, list: the keys of the object.
  std::vector<KeyRule> rules = {};            ///< group, map, list: which of them belong together.
  std::vector<std::string> preset_json = {};  ///< group: the object that each preset stands for.
  std::string name_words = {};                ///< map: what its keys are, "a sensor's name".
  std::optional<NameRule> name_rule = {};     ///< text: which names are allowed.
  bool may_be_empty = false;                  ///< text: the empty string is allowed.
  std::string definition = {};  ///< json: the definition of the JSON Schema that describes it.
};

}  // namespace croon::params
