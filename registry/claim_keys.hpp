#pragma once

#include <limits>
#include <string>
#include <vector>

#include "framework/params/table.hpp"

namespace croon {

/// A number that a source claims, and the band in which ours must lie. Units are those of reports:
/// deg, m, and % for shares. Decides no trial.
struct Expectation {
  std::string claim;    ///< What the number is, in words.
  std::string source;   ///< "paper, Table 1".
  std::string variant;  ///< One of the experiment's; the first where the file names none.
  std::string sensor;   ///< Empty for all sensors together.
  std::string measure;  ///< One of `kClaimMeasures`; empty for the shares.
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

/// Percent of the trials, and percent of the scenes in which every trial succeeds.
inline constexpr const char* kSuccess = "success";
inline constexpr const char* kScenes = "scenes";
/// Standard deviation inside scenes and between them, as in the summary.
inline constexpr const char* kWithinSceneStd = "within_scene_std";
inline constexpr const char* kAcrossScenesStd = "across_scenes_std";

/// The statistics that are shares of trials or scenes, those of one number per trial, all.
inline const std::vector<std::string> kShareStatistics = {kSuccess, kScenes};
inline const std::vector<std::string> kTrialStatistics = {"mean", "std", "median", "rmse", "p95"};
inline const std::vector<std::string> kClaimStatistics = {
    kSuccess, kScenes, "mean", "std", "median", "rmse", "p95", kWithinSceneStd, kAcrossScenesStd};

/// What is measured of a trial, as reports call it.
inline const std::vector<std::string> kClaimMeasures = {"roll", "pitch", "yaw",      "x",
                                                        "y",    "z",     "rotation", "translation"};

/// True for the statistics that are shares of trials or scenes and have no measure.
inline bool is_share(const std::string& statistic) {
  return statistic == kSuccess || statistic == kScenes;
}

/// `parameter` as one that must be there, whatever its default, or need not.
template <class P>
params::Parameter<P> with_need(params::Parameter<P> parameter, bool is_required) {
  parameter.doc.is_required = is_required;
  return parameter;
}

/// What the loader reads and the schema tells of an element of "expect".
inline const params::Table<Expectation>& expectation_table() {
  using P = Expectation;
  static const params::Table<P> table = {
      params::text("claim", &P::claim, "What the number is, in words."),
      params::text("source", &P::source, "Where it stands."),
      with_need(params::text("variant", &P::variant,
                             "The variant that is meant; the first where none is named."),
                false),
      with_need(params::text("sensor", &P::sensor,
                             "The sensor that is meant; all together where none is named."),
                false),
      with_need(params::choice("measure", &P::measure, kClaimMeasures,
                               "What is measured, in deg or m; shares have none."),
                false),
      with_need(params::choice("statistic", &P::statistic, kClaimStatistics,
                               "Which statistic; success and scenes are shares in %."),
                true),
      with_need(params::number("value", &P::value, {}, "What the source says, in deg, m or %."),
                true),
      with_need(params::numbers("band", &P::band, {}, "Lowest and highest of ours."), true),
      with_need(params::text("why", &P::why, "Why ours may differ."), false),
  };
  return table;
}

/// What the loader reads and the schema tells of an element of "quoted".
inline const params::Table<Quoted>& quoted_table() {
  using P = Quoted;
  const auto error = [](const char* key, double P::*value, const std::string& dof) {
    return with_need(params::number(key, value, {}, "Its error in " + dof + "."), true);
  };
  static const params::Table<P> table = {
      params::text("method", &P::method, "The method's name."),
      params::text("source", &P::source, "Where its numbers stand."),
      with_need(params::choice("statistic", &P::statistic, kTrialStatistics,
                               "Which statistic the numbers are."),
                true),
      error("pitch_deg", &P::pitch_deg, "pitch"),
      error("roll_deg", &P::roll_deg, "roll"),
      error("yaw_deg", &P::yaw_deg, "yaw"),
      error("x_m", &P::x_m, "x"),
      error("y_m", &P::y_m, "y"),
      error("z_m", &P::z_m, "z"),
  };
  return table;
}

}  // namespace croon
