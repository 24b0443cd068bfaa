#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "framework/params/table.hpp"

namespace croon::experiments {

/// The trials included in a statistic.
enum class Over {
  successful,  ///< Counted trials: with ground truth the successful ones, else the agreeing ones.
  usable       ///< All trials that finished and were not rejected.
};

/// The name of all sensors together in files and tables; no sensor has this name.
inline constexpr const char* kAllSensors = "all";

/// The maximum number of claims, including those in tables of claims.
inline constexpr std::size_t kMaxClaims = 10000;

/// The name of `sensor` in files and tables; "" is all sensors together.
inline std::string name_of_sensor(const std::string& sensor) {
  return sensor.empty() ? kAllSensors : sensor;
}

/// A number claimed by a source, and the band in which ours must lie. Units are those of reports:
/// deg, m, and % for shares. A claim does not affect trials.
struct Claim {
  std::string claim;      ///< What the number means, in words.
  std::string source;     ///< "paper, Table 1".
  std::string variant;    ///< A variant of the experiment; the first if the file names none.
  std::string sensor;     ///< Empty for all sensors together.
  std::string measure;    ///< One of measure_names(); empty for shares.
  std::string statistic;  ///< One of claim_statistics().
  Over over = Over::successful;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< Number in the source.
  /// Minimum and maximum of our number, inclusive.
  std::array<double, 2> band = {std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::quiet_NaN()};
  std::string why;  ///< Why ours may differ; may be empty.

  /// The position of the sensor's name in the experiment file.
  std::string sensor_file = {}, sensor_pointer = {};
};

/// Mean errors of a method that this program does not run, as given by a source.
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

/// Percentage of trials that succeed, of trials that agree with the consensus of their scene, and
/// of scenes in which every trial succeeds.
inline constexpr const char* kSuccess = "success";
inline constexpr const char* kAgreement = "agreement";
inline constexpr const char* kScenes = "scenes";
/// Standard deviations within and across scenes, as in the summary.
inline constexpr const char* kWithinSceneStd = "within_scene_std";
inline constexpr const char* kAcrossScenesStd = "across_scenes_std";

/// The possible statistics of claims: the shares, the statistics of trials, the two spreads.
const std::vector<std::string>& claim_statistics();

/// "successful" or "usable".
const std::string& word_of_over(Over over);

/// Whether a statistic is a share of trials or scenes, which has no measure.
bool is_share(const std::string& statistic);

/// The row "claims" of the experiment `P`. In the file an element is a single claim, or a table of
/// values that is expanded to one claim per sensor, measure and statistic. Canonical JSON contains
/// the single claims.
template <class P>
params::Parameter<P> claims_row(std::vector<Claim> P::*claims);

/// The documentation of the key "claims".
const params::ParameterDoc& claims_doc();

/// The claims of the list `node`, with tables expanded. Notes faults in the node.
std::vector<Claim> read_claims(const params::Node& node);

/// The list of single claims as JSON.
std::string claims_json(const std::vector<Claim>& claims);

/// The keys of an element of "quoted".
const params::Table<Quoted>& quoted_table();

template <class P>
params::Parameter<P> claims_row(std::vector<Claim> P::*claims) {
  return {claims_doc(),
          [claims](P& params, const params::Node& node, const params::StageBuilder&) {
            params.*claims = read_claims(node);
          },
          [claims](const P& params) { return claims_json(params.*claims); }, false};
}

}  // namespace croon::experiments
