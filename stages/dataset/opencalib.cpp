#include <algorithm>
#include <set>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/params/repeats.hpp"
#include "framework/recording/recording.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::dataset {
namespace {

namespace fs = std::filesystem;

struct Params {
  std::string path;
  std::vector<std::string> scenes;
  bool follow_links = false;
};

params::Table<Params> make_table() {
  params::Table<Params> table = {
      params::text("path", &Params::path,
                   "A folder of scenes, or the folder of one scene (with lidar_cloud_path.txt), "
                   "relative to the data root."),
      params::texts("scenes", &Params::scenes, kScenesDoc),
      params::boolean("follow_links", &Params::follow_links,
                      "Whether symbolic links may point outside the data root."),
  };
  return table.finish([](const Params& params, const params::Node& node) {
    params::refuse_repeats(params.scenes, node, "scenes");
  });
}

const params::Table<Params>& table() {
  static const params::Table<Params> table = make_table();
  return table;
}

constexpr const char* kCloudList = "lidar_cloud_path.txt";
constexpr const char* kPoseList = "initial_extrinsic.txt";

/// The path of a listed cloud. Published lists have paths relative to the scene's folder, to any
/// folder above it, or to one that is not part of the recording.
fs::path find_cloud(const ListedCloud& cloud, const SceneLocation& location) {
  std::string entry = cloud.path;
  std::replace(entry.begin(), entry.end(), '\\', '/');
  std::vector<fs::path> candidates;
  for (const fs::path& folder : folders_up(location)) candidates.push_back(folder / entry);
  candidates.push_back(location.folder / fs::path(entry).filename());
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    const fs::path path = location.links == Links::inside ? fs::canonical(candidate, error)
                                                          : candidate.lexically_normal();
    if (error || !is_within(path, location.root) || !fs::exists(path, error)) continue;
    if (fs::is_regular_file(path, error)) return path;
    throw InputError(
        (location.folder / kCloudList).string(), cloud.place,
        "expected a cloud, found " + found_instead_of_file(path) + " at " + path.string());
  }
  throw InputError(
      (location.folder / kCloudList).string(), cloud.place,
      "the cloud \"" + cloud.path +
          "\" is neither below this folder nor below a folder above it in the data root");
}

/// The initial poses in the recording, by device; the reference's must be zero.
std::map<int, RigidTransform> initial_poses(const SceneLocation& location) {
  const fs::path file = location.folder / kPoseList;
  if (!fs::exists(file)) return {};
  std::map<int, RigidTransform> poses;
  for (const ListedPose& pose :
       read_pose_list(path_in_data_root(location.root, file.string(), location.links))) {
    const bool is_zero = pose.T_reference_sensor.rotation.isIdentity(0.0) &&
                         pose.T_reference_sensor.translation.isZero(0.0);
    if (pose.device_id == 0 && !is_zero) {
      throw InputError(file.string(), pose.place, "expected zeros for the reference, device 0");
    }
    poses[pose.device_id] = pose.T_reference_sensor;
  }
  return poses;
}

/// The scans by device, without poses; inspects the file of every cloud.
std::map<int, SensorScan> listed_scans(const SceneLocation& location) {
  const fs::path list = location.folder / kCloudList;
  std::vector<Fault> faults;
  std::set<std::string> names;
  std::map<int, SensorScan> scans;
  for (const ListedCloud& cloud :
       read_cloud_list(path_in_data_root(location.root, list.string(), location.links))) {
    collect_faults(faults, [&] {
      const fs::path file = find_cloud(cloud, location);
      const std::string& name = cloud.sensor;
      if (name.empty()) throw InputError(list.string(), cloud.place, "the sensor has no name");
      if (!names.insert(name).second) {
        throw InputError(list.string(), cloud.place, "duplicate sensor name \"" + name + "\"");
      }
      scans[cloud.device_id] = scan_in_file(name, file);
    });
  }
  if (!faults.empty()) throw InputError(faults);
  if (scans.count(0) == 0)
    throw InputError(list.string(), "", "the reference, device 0, is missing");
  if (scans.size() == 1)
    throw InputError(list.string(), "", "expected a sensor besides the reference, found none");
  return scans;
}

Scene read_scene(const SceneLocation& location, RigFilesAbove& rig_files) {
  std::vector<Fault> faults;
  std::map<int, SensorScan> scans;
  std::map<int, RigidTransform> initial;
  Scene scene;
  scene.name = location.name;
  collect_faults(faults, [&] { scans = listed_scans(location); });
  collect_faults(faults, [&] { initial = initial_poses(location); });
  for (auto& [device_id, scan] : scans) {
    const auto start = initial.find(device_id);
    if (start != initial.end()) scan.initial = start->second;
    (device_id == 0 ? scene.reference : scene.sensors.emplace_back()) = scan;
  }
  collect_faults(faults, [&] { rig_files.complete(scene, location); });
  if (!faults.empty()) throw InputError(faults);
  return scene;
}

/// The folders of scenes by the scenes' names.
using SceneFolders = std::map<std::string, fs::path, SceneOrder>;

SceneFolders scene_folders(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(folder.string(), "", "expected a folder of scenes");
  if (fs::exists(folder / kCloudList)) return {{folder.filename().string(), folder}};
  SceneFolders folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!fs::exists(entry.path() / kCloudList)) continue;
    folders.emplace(entry.path().filename().string(), entry.path());
  }
  if (folders.empty()) {
    throw InputError(folder.string(), "",
                     std::string("expected folders with ") + kCloudList + ", found none");
  }
  return folders;
}

/// The scenes named in `chosen` among those in `folder`, or `folder` itself if it is a scene.
std::vector<SceneLocation> scene_locations(const fs::path& folder, const fs::path& root,
                                           Links links, const std::vector<std::string>& chosen) {
  const SceneFolders folders = scene_folders(folder);
  std::vector<std::string> names;
  for (const auto& [name, path] : folders) names.push_back(name);
  std::vector<SceneLocation> locations;
  for (const std::string& name : chosen_scenes(std::move(names), chosen)) {
    locations.push_back(
        {name, path_in_data_root(root, folders.at(name).string(), links), root, links});
  }
  return locations;
}

class OpenCalib final : public Dataset {
 public:
  explicit OpenCalib(Params params) : params_(std::move(params)) {}

  std::vector<Scene> scenes(const fs::path& data_root) const override {
    return with_file_errors([&] { return read_scenes(data_root); });
  }

 private:
  std::vector<Scene> read_scenes(const fs::path& data_root) const {
    const Links links = params_.follow_links ? Links::anywhere : Links::inside;
    const fs::path folder = path_in_data_root(data_root, params_.path, links, "/path");
    std::vector<Scene> scenes;
    std::vector<Fault> faults;
    RigFilesAbove rig_files;
    for (const SceneLocation& location :
         scene_locations(folder, fs::canonical(data_root), links, params_.scenes)) {
      collect_faults(faults, [&] { scenes.push_back(read_scene(location, rig_files)); });
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
                                "scene, with a list of its clouds.",
                                "CROON's public code (lidar2lidar, commit c0e1e2b)", table());
}

}  // namespace croon::stages::dataset
