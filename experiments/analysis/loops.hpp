#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/trial_summary.hpp"
#include "experiments/run/sensor_pairs.hpp"

namespace croon::experiments {

/// How far loops over the reference and two sensors, T_ref_target T_target_source T_source_ref, are
/// from the identity. That needs no truth: the three poses are found independently, each from its
/// own start.
struct LoopClosure {
  std::string variant;
  SensorPair pair;
  Share closed;     ///< Of all loops, those within the success bounds of the identity.
  int counted = 0;  ///< Loops of three usable poses, the loops that `statistics` are over.
  std::optional<StatisticsTable>
      statistics;  ///< Of T_ref_target T_target_source from T_ref_source.
};

/// The loops of one variant and pair over `scenes`: trial i of the pair, of its source and of its
/// target are a loop if all three are in `groups`.
LoopClosure close_loops(const RecordGroups& groups, const std::string& variant,
                        const SensorPair& pair, const std::vector<std::string>& scenes,
                        const PoseBounds& bounds);

}  // namespace croon::experiments
