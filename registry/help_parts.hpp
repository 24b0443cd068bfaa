#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// Entries of a catalogue, by kind and then by name; they must outlive the list.
using StageList = std::vector<const StageEntry*>;

/// The stages with their parameters as a JSON array.
std::string json_list(const StageList& stages);

/// The index of the reference pages: the kinds and their stages, with links.
std::string markdown_index(const StageList& stages);
/// The reference page of a kind: each of its stages, `stages`, with its parameters.
std::string markdown_page(const StageList& stages);
/// One stage with its parameters.
std::string markdown_section(const StageEntry& stage);

/// Pairs of a verb and an object for what a stage with default parameters needs or provides, such
/// as ("Needs", "the channel time").
std::vector<std::pair<std::string, std::string>> flow_lines(
    const params::DataFlow& flow, const std::function<std::string(const std::string&)>& mark);

/// "an icp stage", "a yaw_search stage".
std::string kind_phrase(const std::string& kind);

/// A parameter and its path in the stage's JSON: "noise.range_m", "sensors.<name>.model".
struct PlacedParameter {
  std::string path;
  const params::ParameterDoc* parameter;
};

/// The parameters, each followed by its members; `parameters` must outlive the result.
std::vector<PlacedParameter> placed_parameters(const std::vector<params::ParameterDoc>& parameters,
                                               const std::string& above = "");

/// The valid values of a parameter: "a number from 0 to 10", "one of all, non_ground", "an icp
/// stage". `mark` formats each stage kind, choice and key.
std::string type_words(const params::ParameterDoc& doc,
                       const std::function<std::string(const std::string&)>& mark);

/// The default as JSON text, "none" or "required".
std::string default_words(const params::ParameterDoc& doc);

}  // namespace croon
