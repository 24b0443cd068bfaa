#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// A parameter of a stage or of an object in it, in a stage whose conditions hold. Locations are
/// JSON pointers.
struct ParameterPlace {
  std::string stage;                      ///< JSON of the stage that has the object.
  std::string object;                     ///< Where the object stands that has the key.
  const params::ParameterDoc* parameter;  ///< Of the stage's entry.

  /// The location of the parameter's value, also if the key is missing.
  std::string place() const { return object + "/" + parameter->key; }
  /// The location at which a fault of the object as a whole is noted.
  std::string fault_place() const { return object.empty() ? "/" : object; }
  /// True if a fault at `pointer` is one of the object as a whole, or of an object around it.
  bool is_in(const std::string& pointer) const;
  /// The stage with `value` at place().
  nlohmann::json with(const nlohmann::json& value) const;
};

/// The parameters of the stage and of the objects in it, however deep; `entry` must outlive them.
std::vector<ParameterPlace> every_parameter(const StageEntry& entry);

/// The JSON value of the parameter's default; for a preset its object.
nlohmann::json default_value(const params::ParameterDoc& parameter);

}  // namespace croon::test
