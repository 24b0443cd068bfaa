#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// A parameter of a stage or of an object in it, where conditions on the objects hold; places are
/// JSON pointers.
struct ParameterPlace {
  std::string stage;                      ///< JSON of the stage that has the object.
  std::string object;                     ///< Where the object stands that has the key.
  const params::ParameterDoc* parameter;  ///< Of the stage's entry.

  /// Where the parameter's value stands, or would.
  std::string place() const { return object + "/" + parameter->key; }
  /// Where a fault of the object as a whole is noted.
  std::string fault_place() const { return object.empty() ? "/" : object; }
  /// True where a fault at `pointer` is one of the object as a whole, or of one that it is in.
  bool is_in(const std::string& pointer) const;
  /// The stage in which `value` stands there.
  nlohmann::json with(const nlohmann::json& value) const;
};

/// The parameters of the stage and of the objects in it, however deep; `entry` must outlive them.
std::vector<ParameterPlace> every_parameter(const StageEntry& entry);

/// The JSON value of the parameter's default, a preset as the object that it stands for.
nlohmann::json default_value(const params::ParameterDoc& parameter);

}  // namespace croon::test
