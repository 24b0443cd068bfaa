#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/pipeline/pipeline.hpp"

namespace croon::experiments {

/// Which trial: one start of one variant on one sensor of one scene.
struct TrialId {
  std::string variant;
  std::string scene;
  std::string sensor;
  int trial = 0;
};

/// Which trial an estimate belongs to; of no variant. For steps that take results from a file: what
/// a step computes must not depend on it.
inline constexpr Extra<TrialId> kTrialId{"trial id", "which trial it is"};

/// A trial by the indices of its variant, scene and sensor in an experiment, and its number.
/// Reports are in this order.
using TrialIndex = std::tuple<std::size_t, std::size_t, std::size_t, int>;

/// How a trial ended.
enum class Status {
  success,     ///< Finished within the success bounds of the truth.
  inaccurate,  ///< Finished outside them.
  finished,    ///< Finished, and there is no truth to judge the pose by.
  rejected,    ///< The program itself says not to trust the pose.
  failed       ///< A stage could not go on.
};

/// The words for Status, in its order, as files, tables and the store have them.
inline constexpr std::array<const char*, 5> kStatusNames = {"success", "inaccurate", "finished",
                                                            "rejected", "failed"};

inline const char* status_name(Status status) {
  return kStatusNames.at(static_cast<std::size_t>(status));
}

/// The result of a trial, without wall times: the same bits whenever it is run again.
struct TrialRecord {
  TrialId id;
  Status status = Status::failed;
  /// Why it is rejected or failed; of an accepted one, in which of its scenes a step failed and
  /// why.
  std::string reason;
  std::optional<PoseError> error;                    ///< If there is truth and the trial finished.
  std::optional<RigidTransform> T_reference_sensor;  ///< If it finished.
  std::optional<PoseCovariance> covariance;          ///< Of that pose, if a step has estimated it.
  std::vector<StepRecord> steps;  ///< Figures of each step (its seconds go to timings.csv alone).
};

/// One row of timings.csv.
struct TimingRow {
  TrialId id;  ///< Trial -1 and no variant for work that was done once per scene.
  std::string step;
  double seconds = 0.0;
};

}  // namespace croon::experiments
