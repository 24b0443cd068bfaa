#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/recorded_scenes.hpp"

namespace croon {

/// The scenes of a recording in the order of the reference's clouds, one after the other. If the
/// clouds are in a folder per sensor, which may grow, only the names of the next few hundred files
/// are kept in memory.
class SceneStream {
 public:
  /// Reads on from the beginning of `recorded`. In a growing folder, clouds have the same scene if
  /// the names of their files are equal, or at most `max_time_gap_s` apart if these are times.
  SceneStream(RecordedScenes recorded, double max_time_gap_s);

  const std::string& reference() const { return reference_; }
  /// The sensors other than the reference, in the order of the scenes.
  const std::vector<std::string>& sensors() const { return sensors_; }
  /// Whether further scenes may appear.
  bool is_growing() const { return !folders_.empty(); }
  /// The number of scenes; std::nullopt if further ones may appear.
  std::optional<std::size_t> size() const;
  /// Clouds that no scene uses, one sentence each; none if further ones may appear.
  const std::vector<std::string>& unused() const { return recorded_.unused; }
  /// The next scene; std::nullopt if there is none, or none yet. A scene in a growing folder
  /// appears when all its clouds are complete, or if one is not, `kPatience_s` after the last
  /// change: the sensor may have failed.
  std::optional<Scene> next();

  /// How long a missing or incomplete cloud is waited for.
  static constexpr double kPatience_s = 5.0;

 private:
  /// The files of one sensor that may grow.
  struct Folder {
    std::string sensor;
    std::filesystem::path path;
    std::string suffix;
    std::string last_name = {};                     ///< Of the last file that was used.
    std::vector<std::filesystem::path> files = {};  ///< The first ones after it.
  };
  /// Lists the files after the last one that was used.
  static void list(Folder& folder);
  std::optional<Scene> next_in_folders();
  /// The cloud of `folder` at the same moment as the file `reference`; an empty path if it is not
  /// there.
  std::filesystem::path match(const Folder& folder, const std::filesystem::path& reference) const;

  RecordedScenes recorded_;
  double max_time_gap_s_;
  std::string reference_;
  std::vector<std::string> sensors_;
  std::size_t next_ = 0;         ///< In `recorded_`.
  std::vector<Folder> folders_;  ///< The reference's first; empty for other recordings.
};

}  // namespace croon
