#pragma once

#include <filesystem>
#include <optional>
#include <ostream>

#include "experiments/cli/requested_calibration.hpp"

namespace croon::experiments {

/// What `croon check --watch` is asked for.
struct WatchOptions : CalibrateOptions {
  std::optional<std::filesystem::path> log;  ///< A new CSV file with a row per scan and sensor.
  /// Mean time between false alarms of the whole rig, at 10 scans per second.
  std::optional<double> false_alarm_every_h;
  /// Stop if a growing folder has no new scan for so long; never if not given.
  std::optional<double> until_idle_s;
};

/// Audits the poses in the file `options.nominal` by one scan after another of `options.inputs`:
/// prints a line for each change of a verdict, and at the end the verdict of each sensor. Progress
/// goes to `err`. Ends with the recording, or for folders that may grow, on SIGINT, SIGTERM or
/// after `until_idle_s`. Returns 3 if a sensor has drifted at the end, or if none was decidable.
/// Throws InputError if the request is wrong or the log exists.
int watch_command(const WatchOptions& options, std::ostream& out, std::ostream& err);

}  // namespace croon::experiments
