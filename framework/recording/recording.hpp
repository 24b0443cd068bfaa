#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/io/data_path.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/rig_files.hpp"

namespace croon {

/// A scene on disk: its name, its folder, and the real data root above it.
struct SceneLocation {
  std::string name;
  std::filesystem::path folder;
  std::filesystem::path root;
  Links links = Links::inside;
};

/// The folder and those above it, up to the data root.
std::vector<std::filesystem::path> folders_up(const SceneLocation& location);

/// The poses and the kinds of scenes that stand in files beside scenes or in folders above them,
/// the nearest file counts. Each file is read once, for it may be about thousands of scenes.
class RigFilesAbove {
 public:
  /// Sets the kind of `scene` (`scene_kinds.json`) and the true and the nominal poses of its
  /// sensors (`truth.json`, `nominal.json`). Throws InputError with the faults of all files.
  void complete(Scene& scene, const SceneLocation& location);

 private:
  std::map<std::filesystem::path, SceneKinds> kinds_;
  std::map<std::filesystem::path, RigPoses> poses_;
};

/// The scan of `sensor` in the file of a cloud, without poses.
/// Throws InputError if its header shows that it cannot be read.
SensorScan scan_in_file(const std::string& sensor, const std::filesystem::path& file);

/// What the parameter `scenes` of a recording does.
inline constexpr const char* kScenesDoc =
    "The names of the scenes that take part; an empty list is all of them.";

/// Those of the scenes `names` that are in `chosen`, in the order of `names`; all if `chosen` is
/// empty. Throws InputError, at the pointers of the parameter `scenes`, for names that are none.
std::vector<std::string> chosen_scenes(std::vector<std::string> names,
                                       const std::vector<std::string>& chosen);

/// Returns what `read` returns; a std::filesystem::filesystem_error becomes an InputError.
std::vector<Scene> with_file_errors(const std::function<std::vector<Scene>()>& read);

/// Whether the scene called `a` comes before that called `b`: names that are whole numbers first,
/// by number, so that 1000000 comes after 999999; then the others as text.
struct SceneOrder {
  bool operator()(const std::string& a, const std::string& b) const;
};

/// Why a scene or a sensor cannot be called `name`, for a message, as names stand in tables and are
/// those of files; empty if it can. `what` is "a sensor".
std::string why_no_scan_name(const std::string& name, const std::string& what);

}  // namespace croon
