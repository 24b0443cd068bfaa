#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// "an icp stage", "a yaw_search stage".
std::string kind_phrase(const std::string& kind);

/// A parameter and where it stands in the stage's JSON: "noise.range_m", "sensors.<name>.model".
struct PlacedParameter {
  std::string path;
  const params::ParameterDoc* parameter;
};

/// The parameters, each followed by those of the objects in it; the documents must outlive them.
std::vector<PlacedParameter> placed_parameters(const std::vector<params::ParameterDoc>& parameters,
                                               const std::string& above = "");

/// What a parameter takes: "a number from 0 to 10", "one of all, non_ground", "an icp stage". Each
/// stage kind, choice and key goes through `mark` first.
std::string type_words(const params::ParameterDoc& doc,
                       const std::function<std::string(const std::string&)>& mark);

/// The default as JSON text, or "required".
std::string default_words(const params::ParameterDoc& doc);

}  // namespace croon
