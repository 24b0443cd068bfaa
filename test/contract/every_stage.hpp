#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// A name of the user's choosing, the key of a value in a map.
constexpr const char* kAnyName = "any_name";

/// The least JSON object that these parameters are read from: the keys that must be there.
nlohmann::ordered_json minimal_object(const std::vector<params::ParameterDoc>& parameters);

/// The least JSON object that builds the stage: its name, and the keys that must be there.
std::string minimal_json(const StageEntry& entry);

/// A stage of the registry, which outlives the cases; gtest copies a case often, in every process.
using StageCase = std::reference_wrapper<const StageEntry>;

/// The stages of the registry but those of the kinds `left_out`.
std::vector<StageCase> every_stage(const std::vector<std::string>& left_out = {});

/// The stages of one kind.
std::vector<StageCase> every_stage_of(const std::string& kind);

/// What gtest calls the case of one stage: "icp_icpn".
std::string stage_case_name(const testing::TestParamInfo<StageCase>& info);

/// A suite that runs over stages; its cases come from the registry, so a new stage is tested
/// without an edit.
class EveryStage : public testing::TestWithParam<StageCase> {
 protected:
  const StageEntry& entry() const { return GetParam(); }
};

}  // namespace croon::test

namespace croon {

/// How gtest prints a case.
inline void PrintTo(const std::reference_wrapper<const StageEntry>& entry, std::ostream* out) {
  *out << entry.get().kind << "/" << entry.get().name;
}

}  // namespace croon
