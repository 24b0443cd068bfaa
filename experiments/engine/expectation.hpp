#pragma once

#include <limits>
#include <string>
#include <vector>

#include "framework/params/node.hpp"

namespace croon::experiments {

/// A number that a source claims, and the band in which ours must lie. Units are those of reports:
/// deg, m, and % for shares. Decides no trial.
struct Expectation {
  std::string claim;    ///< What the number is, in words.
  std::string source;   ///< "paper, Table 1".
  std::string variant;  ///< One of the experiment's; the first where the file names none.
  std::string sensor;   ///< Empty for all sensors together.
  std::string measure;  ///< One of `kMeasures`; empty for the shares.
  std::string statistic;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< What the source says.
  std::vector<double> band;                                 ///< Closed: its low and its high end.
  std::string why;                                          ///< Why ours may differ; may be empty.
};

/// Mean errors of a method that this program does not run, as a source has them.
struct Quoted {
  std::string method;
  std::string source;
  std::string statistic;
  double roll_deg = std::numeric_limits<double>::quiet_NaN();
  double pitch_deg = std::numeric_limits<double>::quiet_NaN();
  double yaw_deg = std::numeric_limits<double>::quiet_NaN();
  double x_m = std::numeric_limits<double>::quiet_NaN();
  double y_m = std::numeric_limits<double>::quiet_NaN();
  double z_m = std::numeric_limits<double>::quiet_NaN();
};

/// What an experiment is held against.
struct Claims {
  std::vector<Expectation> expect;
  std::vector<Quoted> quoted;
};

/// Percent of the trials, and percent of the scenes in which every trial succeeds.
inline constexpr const char* kSuccess = "success";
inline constexpr const char* kScenes = "scenes";
/// Standard deviation inside scenes and between them, as in the summary.
inline constexpr const char* kWithinSceneStd = "within_scene_std";
inline constexpr const char* kAcrossScenesStd = "across_scenes_std";

/// True for the statistics that are shares of trials or scenes and have no measure.
inline bool is_share(const std::string& statistic) {
  return statistic == kSuccess || statistic == kScenes;
}

/// The claims in the keys "expect" and "quoted" of the experiment `root`, whose variants are
/// called `variants` (none where they are faulty). Notes faults in the node.
Claims read_claims(const params::Node& root, const std::vector<std::string>& variants);

/// Canonical JSON text of the claims: `{"expect":[...],"quoted":[...]}`.
std::string claims_json(const Claims& claims);

/// The claims that `claims_json` wrote. `file` is where `text` comes from; throws InputError where
/// it is none.
Claims claims_of(const std::string& text, const std::string& file);

}  // namespace croon::experiments
