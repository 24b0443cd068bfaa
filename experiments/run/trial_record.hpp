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

/// Identifies a trial: one start of one variant on one sensor of one scene.
struct TrialId {
  std::string variant;
  std::string scene;
  std::string sensor;
  int trial = 0;
};

/// The name of a trial in a command: "base/000001/left/0".
inline std::string trial_name(const TrialId& id) {
  return id.variant + "/" + id.scene + "/" + id.sensor + "/" + std::to_string(id.trial);
}

/// Identifies the trial of an estimate, without the variant. For steps that read results from a
/// file; computations of a step must not depend on it.
inline constexpr Extra<TrialId> kTrialId{"trial id", "which trial it is"};

/// A trial by the indices of its variant, scene and sensor in an experiment, and its number; the
/// order of reports.
using TrialIndex = std::tuple<std::size_t, std::size_t, std::size_t, int>;

/// How a trial ended.
enum class Status {
  success,     ///< Finished within the success bounds of ground truth.
  inaccurate,  ///< Finished outside these bounds.
  finished,    ///< Finished; there is no ground truth to judge the pose.
  rejected,    ///< The program rejected its own pose.
  failed       ///< A stage could not continue.
};

/// The names of Status, in its order, as used in files, tables and the store.
inline constexpr std::array<const char*, 5> kStatusNames = {"success", "inaccurate", "finished",
                                                            "rejected", "failed"};

inline const char* status_name(Status status) {
  return kStatusNames.at(static_cast<std::size_t>(status));
}

/// The result of a trial, without wall times: the same bits whenever it is run again.
struct TrialRecord {
  TrialId id;
  Status status = Status::failed;
  /// Why the trial was rejected or failed; for an accepted trial, the scene in which a step failed
  /// and why.
  std::string reason;
  std::optional<PoseError> error;  ///< Only with ground truth, if the trial finished.
  std::optional<RigidTransform> T_reference_sensor;  ///< Only if the trial finished.
  std::optional<PoseCovariance> covariance;  ///< Covariance of that pose, if a step estimated it.
  std::vector<StepRecord>
      steps;  ///< Diagnostics of each step; its seconds are only in timings.csv.
};

/// One row of timings.csv.
struct TimingRow {
  TrialId id;  ///< Trial -1 and no variant for work done once per scene.
  std::string step;
  double seconds = 0.0;
};

}  // namespace croon::experiments
