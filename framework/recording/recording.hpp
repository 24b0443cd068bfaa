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

/// Reads poses and kinds of scenes from files beside scenes or in folders above them; the nearest
/// file counts. Each file is read once, because it may apply to thousands of scenes.
class RigFilesAbove {
 public:
  /// Sets the kind of `scene` (`scene_kinds.json`) and the true and the nominal poses of its
  /// sensors (`truth.json`, `nominal.json`). Throws InputError with the faults of all files.
  void complete(Scene& scene, const SceneLocation& location);

 private:
  std::map<std::filesystem::path, SceneKinds> kinds_;
  std::map<std::filesystem::path, RigPoses> poses_;
};

/// The scan of `sensor` in the file of a cloud, without poses. Throws InputError if the header of
/// the file is invalid.
SensorScan scan_in_file(const std::string& sensor, const std::filesystem::path& file);

/// Help text of the parameter `scenes` of a recording.
inline constexpr const char* kScenesDoc =
    "Names of the scenes that are used; an empty list means all of them.";

/// The scenes in `names` that are also in `chosen`, in the order of `names`; all if `chosen` is
/// empty. Throws InputError, with JSON pointers into the parameter `scenes`, for unknown names.
std::vector<std::string> chosen_scenes(std::vector<std::string> names,
                                       const std::vector<std::string>& chosen);

/// Returns what `read` returns; a std::filesystem::filesystem_error becomes an InputError.
std::vector<Scene> with_file_errors(const std::function<std::vector<Scene>()>& read);

/// Whether the scene `a` comes before `b`: whole numbers first, by value, so that 1000000 comes
/// after 999999; then other names as text.
struct SceneOrder {
  bool operator()(const std::string& a, const std::string& b) const;
};

/// Why `name` is not a valid name for a scene or sensor, for a message; empty if it is valid. Names
/// are used in tables and as file names. `what` is, for example, "a sensor".
std::string why_no_scan_name(const std::string& name, const std::string& what);

}  // namespace croon
