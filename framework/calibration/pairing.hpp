#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace croon {

/// The measurement times of one sensor's clouds.
struct SensorStamps {
  std::string sensor;
  std::vector<double> stamps_s;  ///< Ascending, in one clock for all sensors.
};

/// The files of one sensor, with one cloud each.
struct SensorFiles {
  std::string sensor;
  std::filesystem::path folder;  ///< For messages.
  std::vector<std::filesystem::path> files;
};

/// The clouds of one moment.
struct PairedScene {
  std::string name;  ///< The stamp in seconds with six decimals, or the stem of the file names.
  /// By sensor, in the input order: the index of its cloud. Every scene has a cloud of the
  /// reference and of at least one other sensor.
  std::vector<std::optional<std::size_t>> clouds;
};

/// The scenes of a recording, in the order of the reference's clouds.
struct Pairing {
  std::vector<PairedScene> scenes;
  /// One line per sensor with unused clouds: number and reason.
  std::vector<std::string> unpaired;
  bool is_by_time = false;
};

/// Makes a scene of each cloud of the reference, with the nearest cloud of every other sensor if it
/// is at most `max_time_gap_s` away. A cloud that is nearest to several reference clouds is paired
/// with the nearest of them. `reference` must be the name of one of the sensors.
Pairing pair_by_time(const std::vector<SensorStamps>& sensors, const std::string& reference,
                     double max_time_gap_s);

/// Pairs files whose names without suffix are equal. If the names of all files are time stamps, in
/// s, ms, us or ns since 1970, they are paired by time instead. If each sensor has a single file,
/// these form one scene whatever their names. Throws InputError if a sensor has no files, two files
/// with the same name, or no name in common with the reference.
Pairing pair_by_name(const std::vector<SensorFiles>& sensors, const std::string& reference,
                     double max_time_gap_s);

/// The time at the end of a file name without suffix, in seconds since 1970: a number whose
/// magnitude implies s (fractions allowed), ms, us or ns, or seconds, a separator and nine digits
/// of nanoseconds; std::nullopt if there is none.
std::optional<double> stamp_in_name(const std::string& stem);

}  // namespace croon
