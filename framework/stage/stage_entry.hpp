#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/params/table.hpp"

namespace croon {

/// A kind of stage, as described by its class (see `stage_entry`).
struct StageKind {
  std::string name;     ///< "ground_extractor", "icp", ...
  std::string summary;  ///< The purpose of its stages; one sentence.
  int order = 0;        ///< Position in lists of kinds, which follow the order of a calibration.
};

/// The registry's entry for one stage: its kind and name, its purpose, its parameters, and how to
/// build it.
struct StageEntry {
  std::string kind;          ///< The kind's name.
  std::string name;          ///< The JSON "type" ("step" for a step), the file's name.
  std::string summary;       ///< One sentence.
  std::string source;        ///< Its origin: the paper and section, or "croon".
  std::string kind_summary;  ///< See StageKind; the same for all stages of the kind.
  int kind_order = 0;        ///< Likewise.
  std::vector<params::ParameterDoc> parameters;
  std::function<params::BuiltStage(const params::Node&, const params::StageBuilder&)> build;
  int version = 1;        ///< See stage_entry.
  params::DataFlow flow;  ///< With default parameters; without the stages in its slots.
};

/// The data flow that the class `Stage` declares for the parameters `params`; std::nullopt if it
/// declares none.
template <class Stage, class P>
auto stated_flow(const P& params, int) -> decltype(std::optional(Stage::data_flow(params))) {
  return Stage::data_flow(params);
}
template <class Stage, class P>
std::optional<params::DataFlow> stated_flow(const P&, long) {
  return std::nullopt;
}

/// The JSON key that names a stage of `kind`: "step" for steps, else "type".
inline std::string name_key(const std::string& kind) { return kind == "step" ? "step" : "type"; }

/// The keys of a stage's JSON object that are not parameters: its name, and for a step the optional
/// "name" used in variants and timings.
inline std::vector<std::string> reserved_keys(const std::string& kind) {
  return kind == "step" ? std::vector<std::string>{"step", "name"}
                        : std::vector<std::string>{"type"};
}

/// The entry of the stage class `Stage`, whose constructor takes the struct `P` that `table` reads.
/// `Stage` derives from the class of its kind, which declares the kind: `Kind` (itself), `kKind`,
/// `kKindSummary` and `kKindOrder`, see StageKind. The kinds are not listed anywhere else, so a
/// header with such a class defines a new kind of stage.
///
/// A stage that needs a channel of its clouds, or reads or provides an extra, declares so in
/// `static params::DataFlow data_flow(const P&)`. A stage without this function needs and provides
/// what the stages in its slots do.
///
/// Increment `version` with every change that alters the stage's results: a store never contains
/// trials of two versions. A test compares test/house/stage_versions.txt with the sources.
template <class Stage, class P>
StageEntry stage_entry(const std::string& name, const std::string& summary,
                       const std::string& source, const params::Table<P>& table, int version = 1) {
  using Kind = typename Stage::Kind;
  StageEntry entry{Kind::kKind,
                   name,
                   summary,
                   source,
                   Kind::kKindSummary,
                   Kind::kKindOrder,
                   table.docs(),
                   {},
                   version,
                   stated_flow<Stage>(P{}, 0).value_or(params::DataFlow())};
  entry.build = [name, table](const params::Node& node, const params::StageBuilder& builder) {
    const P params = table.read(node, reserved_keys(Kind::kKind), builder);
    if (node.fault_count() > 0) return params::BuiltStage{};
    const std::shared_ptr<const Kind> stage = std::make_shared<const Stage>(params);
    const params::Members first = {{name_key(Kind::kKind), params::value_json(name)}};
    return params::BuiltStage{
        stage, name, table.json(params, first), {}, stated_flow<Stage>(params, 0)};
  };
  return entry;
}

}  // namespace croon
