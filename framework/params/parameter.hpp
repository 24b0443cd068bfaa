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

/// The rule for valid names: at least one character; letters, digits and `marks`; the first (last)
/// character is not one of `not_first` (`not_last`).
struct NameRule {
  std::string marks;
  std::string words;  ///< Description for messages: "a name of letters, digits, _ and -".
  std::string not_first = {};
  std::string not_last = {};

  bool allows(const std::string& name) const;
  /// The same rule as a regular expression of JSON Schema.
  std::string pattern() const;
};

/// A dependency between keys of one object. The rule applies if the object has `key` and, if
/// `words` is not empty, its value is one of them. Then every key of `required` must be present and
/// no key of `excluded` may be. Canonical JSON omits excluded keys.
struct KeyRule {
  std::string key;  ///< "file"; "sweep/rotation_deg" is a key of a nested object.
  std::vector<std::string> words = {};
  bool is_negated = false;  ///< Applies if the key is missing or, with `words`, has another value.
  std::vector<std::string> required = {};
  std::vector<std::string> excluded = {};
  std::string expected = {};  ///< For messages on excluded keys: "no key beside \"file\"".
  /// If not empty, all other members are ignored: exactly one of these keys must be present.
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

/// Everything about one parameter: reading, help, JSON Schema, canonical JSON and the reference
/// page are derived from it.
struct ParameterDoc {
  std::string key;
  ParameterType type = ParameterType::number;
  std::string default_json;          ///< JSON text of the default.
  Range range;                       ///< integer, number, numbers, interval, per_axis.
  std::vector<std::string> choices;  ///< choice, choices; the names of a group's presets.
  std::string stage_kind;            ///< stage, stages.
  std::string sentence;              ///< Its purpose; one sentence with a full stop.
  bool is_required = false;          ///< The key is required; `default_json` is then meaningless.
  bool is_optional = false;          ///< The key may be missing and has no default.
  std::vector<ParameterDoc> members = {};     ///< group, map, list: the keys of the object.
  std::vector<KeyRule> rules = {};            ///< group, map, list: dependencies between its keys.
  std::vector<std::string> preset_json = {};  ///< group: the object of each preset.
  std::string name_words = {};                ///< map: description of its keys: "a sensor's name".
  std::optional<NameRule> name_rule = {};     ///< text: which names are allowed.
  bool may_be_empty = false;                  ///< text: the empty string is allowed.
  std::string definition = {};  ///< json: the JSON Schema definition that describes it.
  std::string former_key = {};  ///< Read like `key`, with a note; see Parameter::formerly.
};

}  // namespace croon::params
