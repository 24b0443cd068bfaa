#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace croon {

/// When the clouds of one sensor were measured.
struct SensorStamps {
  std::string sensor;
  std::vector<double> stamps_s;  ///< Ascending, of one clock for all sensors.
};

/// The files of one sensor, one cloud each.
struct SensorFiles {
  std::string sensor;
  std::filesystem::path folder;  ///< For messages.
  std::vector<std::filesystem::path> files;
};

/// The clouds of one moment.
struct PairedScene {
  std::string name;  ///< The stamp in seconds with six decimals, or the stem of the file names.
  /// Per sensor, in the order in which the sensors were given: the index of its cloud. Every scene
  /// has one of the reference and one of another sensor.
  std::vector<std::optional<std::size_t>> clouds;
};

/// The scenes of a recording, in the order of the reference's clouds.
struct Pairing {
  std::vector<PairedScene> scenes;
  std::vector<std::string> unpaired;  ///< A line per sensor with clouds in no scene: how many, why.
  bool is_by_time = false;
};

/// A scene per cloud of the reference, with the nearest cloud of every other sensor if it is at
/// most `max_time_gap_s` away. A cloud that is the nearest of several belongs to the nearest of
/// them. `reference` must be the name of one of the sensors.
Pairing pair_by_time(const std::vector<SensorStamps>& sensors, const std::string& reference,
                     double max_time_gap_s);

/// Pairs files whose names without suffix are equal. If the names of all files are time stamps, in
/// s, ms, us or ns since 1970, they are paired by time instead. A single file of each sensor is one
/// scene, whatever the names. Throws InputError: a sensor without files, two files with one name,
/// or a sensor none of whose names is one of the reference's.
Pairing pair_by_name(const std::vector<SensorFiles>& sensors, const std::string& reference,
                     double max_time_gap_s);

/// The time at the end of a file name without suffix, in seconds since 1970: a number whose
/// magnitude shows that it is in s (fractions allowed), ms, us or ns, or seconds and nine digits of
/// nanoseconds with a sign between them; std::nullopt if there is none.
std::optional<double> stamp_in_name(const std::string& stem);

}  // namespace croon
