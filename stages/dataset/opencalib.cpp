#include <algorithm>
#include <set>

#include "framework/base/error.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/rig_files.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::dataset {
namespace {

namespace fs = std::filesystem;

struct Params {
  std::string path;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::text(
          "path", &Params::path,
          "A folder of scenes, or one scene's folder (it has lidar_cloud_path.txt); relative to "
          "the data root."),
  };
  return table;
}

constexpr const char* kCloudList = "lidar_cloud_path.txt";
constexpr const char* kPoseList = "initial_extrinsic.txt";

/// A scene on disk: its name, its real folder, and the real data root above it.
struct SceneLocation {
  std::string name;
  fs::path folder;
  fs::path root;
};

/// The folder and those above it, up to the data root.
std::vector<fs::path> folders_up(const SceneLocation& location) {
  std::vector<fs::path> folders = {location.folder};
  while (folders.back() != location.root) folders.push_back(folders.back().parent_path());
  return folders;
}

/// The real path of a listed cloud. Lists in circulation have paths relative to whatever folder
/// their authors stood in: the scene's, any above it, or one that did not come along with the
/// recording.
fs::path find_cloud(const ListedCloud& cloud, const SceneLocation& location) {
  std::string entry = cloud.path;
  std::replace(entry.begin(), entry.end(), '\\', '/');
  std::vector<fs::path> candidates;
  for (const fs::path& folder : folders_up(location)) candidates.push_back(folder / entry);
  candidates.push_back(location.folder / fs::path(entry).filename());
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    const fs::path real = fs::canonical(candidate, error);
    if (!error && fs::is_regular_file(real, error) && is_within(real, location.root)) return real;
  }
  throw InputError((location.folder / kCloudList).string(), cloud.place,
                   "the cloud \"" + cloud.path +
                       "\" is not below this folder, nor below one above it in the data root");
}

/// "left" of "left-2022-02-15.pcd": a file's name up to the first hyphen.
std::string sensor_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.find('-'));
}

/// The file `name` beside the scene or above it, the nearest.
std::optional<fs::path> file_above(const std::string& name, const SceneLocation& location) {
  for (const fs::path& folder : folders_up(location)) {
    if (fs::exists(folder / name))
      return path_in_data_root(location.root, (folder / name).string());
  }
  return std::nullopt;
}

/// The poses in `name` beside the scene or above it; none if there is no such file.
RigPoses poses_above(const std::string& name, const SceneLocation& location) {
  const std::optional<fs::path> file = file_above(name, location);
  return file ? read_rig_poses(*file) : RigPoses{};
}

/// The files with kinds of scenes that were read: one file may be about thousands of scenes.
using KindFiles = std::map<fs::path, SceneKinds>;

/// The kind that the file beside the scene or above it gives; empty if there is none.
std::string kind_of(const SceneLocation& location, KindFiles& read) {
  const std::optional<fs::path> file = file_above("scene_kinds.json", location);
  if (!file) return "";
  auto kinds = read.find(*file);
  if (kinds == read.end()) kinds = read.emplace(*file, read_scene_kinds(*file)).first;
  const auto kind = kinds->second.find(location.name);
  return kind == kinds->second.end() ? "" : kind->second;
}

template <class Poses, class Key>
std::optional<RigidTransform> pose_of(const Poses& poses, const Key& key) {
  const auto found = poses.find(key);
  return found == poses.end() ? std::nullopt : std::make_optional(found->second);
}

/// The starts that the recording came with, by device; the reference's must be zero.
std::map<int, RigidTransform> initial_poses(const SceneLocation& location) {
  const fs::path file = location.folder / kPoseList;
  if (!fs::exists(file)) return {};
  std::map<int, RigidTransform> poses;
  for (const ListedPose& pose : read_pose_list(path_in_data_root(location.root, file.string()))) {
    const bool is_zero = pose.T_reference_sensor.rotation.isIdentity(0.0) &&
                         pose.T_reference_sensor.translation.isZero(0.0);
    if (pose.device_id == 0 && !is_zero) {
      throw InputError(file.string(), pose.place, "expected zeros for the reference, device 0");
    }
    poses[pose.device_id] = pose.T_reference_sensor;
  }
  return poses;
}

/// The scans by device, without poses; looks at every cloud's file.
std::map<int, SensorScan> listed_scans(const SceneLocation& location) {
  const fs::path list = location.folder / kCloudList;
  std::vector<Fault> faults;
  std::set<std::string> names;
  std::map<int, SensorScan> scans;
  for (const ListedCloud& cloud :
       read_cloud_list(path_in_data_root(location.root, list.string()))) {
    collect_faults(faults, [&] {
      const fs::path file = find_cloud(cloud, location);
      check_point_cloud_file(file);
      // The listed name, not that of a file which a link points at.
      std::string entry = cloud.path;
      std::replace(entry.begin(), entry.end(), '\\', '/');
      const std::string name = sensor_name(entry);
      if (name.empty()) throw InputError(list.string(), cloud.place, "the sensor has no name");
      if (!names.insert(name).second) {
        throw InputError(list.string(), cloud.place, "a second sensor is called \"" + name + "\"");
      }
      scans[cloud.device_id] =
          SensorScan{name, file.string(), [file] { return read_point_cloud(file); }, {}, {}, {}};
    });
  }
  if (!faults.empty()) throw InputError(faults);
  if (scans.count(0) == 0)
    throw InputError(list.string(), "", "the reference, device 0, is missing");
  if (scans.size() == 1)
    throw InputError(list.string(), "", "there is no sensor but the reference");
  return scans;
}

Scene read_scene(const SceneLocation& location, KindFiles& kind_files) {
  std::vector<Fault> faults;
  std::string kind;
  std::map<int, SensorScan> scans;
  std::map<int, RigidTransform> initial;
  RigPoses truth, nominal;
  collect_faults(faults, [&] { scans = listed_scans(location); });
  collect_faults(faults, [&] { initial = initial_poses(location); });
  collect_faults(faults, [&] { truth = poses_above("truth.json", location); });
  collect_faults(faults, [&] { nominal = poses_above("nominal.json", location); });
  collect_faults(faults, [&] { kind = kind_of(location, kind_files); });
  if (!faults.empty()) throw InputError(faults);
  Scene scene{location.name, kind, scans.at(0), {}};
  scans.erase(0);
  for (auto& [device_id, scan] : scans) {
    scan.truth = pose_of(truth, scan.sensor);
    scan.nominal = pose_of(nominal, scan.sensor);
    scan.initial = pose_of(initial, device_id);
    scene.sensors.push_back(scan);
  }
  return scene;
}

/// The scenes' folders in `folder`, by name; or `folder` itself if it is a scene.
std::vector<SceneLocation> scene_locations(const fs::path& folder, const fs::path& root) {
  if (!fs::is_directory(folder))
    throw InputError(folder.string(), "", "expected a folder of scenes");
  if (fs::exists(folder / kCloudList)) return {{folder.filename().string(), folder, root}};
  std::vector<SceneLocation> locations;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / kCloudList)) continue;
    locations.push_back(
        {entry.path().filename().string(), path_in_data_root(root, entry.path().string()), root});
  }
  if (locations.empty()) {
    throw InputError(folder.string(), "",
                     std::string("expected folders with ") + kCloudList + ", found none");
  }
  std::sort(locations.begin(), locations.end(),
            [](const SceneLocation& a, const SceneLocation& b) { return a.name < b.name; });
  return locations;
}

class OpenCalib final : public Dataset {
 public:
  explicit OpenCalib(Params params) : params_(std::move(params)) {}

  std::vector<Scene> scenes(const fs::path& data_root) const override {
    try {
      return read_scenes(data_root);
    } catch (const fs::filesystem_error& error) {
      throw InputError(error.path1().string(), "", error.code().message());
    }
  }

 private:
  std::vector<Scene> read_scenes(const fs::path& data_root) const {
    const fs::path folder = path_in_data_root(data_root, params_.path);
    std::vector<Scene> scenes;
    std::vector<Fault> faults;
    KindFiles kind_files;
    for (const SceneLocation& location : scene_locations(folder, fs::canonical(data_root))) {
      collect_faults(faults, [&] { scenes.push_back(read_scene(location, kind_files)); });
    }
    if (!faults.empty()) throw InputError(without_repeats(faults));
    return scenes;
  }

  Params params_;
};

}  // namespace

StageEntry opencalib() {
  return stage_entry<OpenCalib>("opencalib",
                                "Recordings in the layout of the paper's authors: a folder per "
                                "scene, a list of clouds in it.",
                                "CROON's public code (lidar2lidar, commit c0e1e2b)", table());
}

}  // namespace croon::stages::dataset
