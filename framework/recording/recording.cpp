#include "framework/recording/recording.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// The nearest file `name` beside the scene or above it.
std::optional<fs::path> file_above(const std::string& name, const SceneLocation& location) {
  for (const fs::path& folder : folders_up(location)) {
    if (!fs::exists(folder / name)) continue;
    return path_in_data_root(location.root, (folder / name).string(), location.links);
  }
  return std::nullopt;
}

/// The poses in the file `name` above `location` that belong to no sensor of `scene`.
std::vector<UnusedPose> unused_in(const std::string& name, const SceneLocation& location,
                                  const RigPoses& poses, const Scene& scene) {
  std::vector<UnusedPose> unused;
  for (const auto& [sensor, T] : poses) {
    const auto is_it = [&name = sensor](const SensorScan& scan) { return scan.sensor == name; };
    if (is_it(scene.reference)) continue;
    if (std::any_of(scene.sensors.begin(), scene.sensors.end(), is_it)) continue;
    unused.push_back({file_above(name, location)->string(), sensor});
  }
  return unused;
}

/// The content of the file `name` above `location`, from `known` or else read with `read`.
template <class Content, class Read>
Content content_above(const std::string& name, const SceneLocation& location,
                      std::map<fs::path, Content>& known, const Read& read) {
  const std::optional<fs::path> file = file_above(name, location);
  if (!file) return {};
  const auto found = known.find(*file);
  return found != known.end() ? found->second : known.emplace(*file, read(*file)).first->second;
}

/// Reads the poses of a rig. Throws InputError if the pose of `reference` is not zero: then all
/// poses are in another frame, such as the car's.
RigPoses poses_in_frame_of(const std::string& reference, const fs::path& file) {
  constexpr double kZero = 1e-9;
  const RigPoses poses = read_rig_poses(file);
  const auto found = poses.find(reference);
  if (found == poses.end()) return poses;
  const auto& [rotation, translation_m] = found->second;
  if (translation_m.norm() <= kZero && (rotation - Eigen::Matrix3d::Identity()).norm() <= kZero)
    return poses;
  throw InputError(file.string(), "/" + reference,
                   "expected zeros, because poses are in the frame of the reference, found a "
                   "nonzero pose of the reference");
}

std::optional<RigidTransform> pose_of(const RigPoses& poses, const std::string& sensor) {
  const auto found = poses.find(sensor);
  return found == poses.end() ? std::nullopt : std::make_optional(found->second);
}

}  // namespace

std::vector<fs::path> folders_up(const SceneLocation& location) {
  std::vector<fs::path> folders = {location.folder};
  while (folders.back() != location.root) folders.push_back(folders.back().parent_path());
  return folders;
}

void RigFilesAbove::complete(Scene& scene, const SceneLocation& location) {
  std::vector<Fault> faults;
  SceneKinds kinds;
  RigPoses truth, nominal;
  const auto read_poses = [&](const fs::path& file) {
    return poses_in_frame_of(scene.reference.sensor, file);
  };
  collect_faults(faults,
                 [&] { truth = content_above("truth.json", location, poses_, read_poses); });
  collect_faults(faults,
                 [&] { nominal = content_above("nominal.json", location, poses_, read_poses); });
  collect_faults(faults, [&] {
    kinds = content_above("scene_kinds.json", location, kinds_, read_scene_kinds);
  });
  if (!faults.empty()) throw InputError(std::move(faults));
  const auto kind = kinds.find(scene.name);
  if (kind != kinds.end()) scene.kind = kind->second;
  scene.unused_truth = unused_in("truth.json", location, truth, scene);
  scene.unused_nominal = unused_in("nominal.json", location, nominal, scene);
  for (SensorScan& scan : scene.sensors) {
    scan.truth = pose_of(truth, scan.sensor);
    scan.nominal = pose_of(nominal, scan.sensor);
  }
}

SensorScan scan_in_file(const std::string& sensor, const fs::path& file) {
  SensorScan scan;
  scan.sensor = sensor;
  scan.file = file.string();
  scan.channels = check_point_cloud_file(file);
  scan.load = [file] { return read_point_cloud(file); };
  return scan;
}

std::vector<std::string> chosen_scenes(std::vector<std::string> names,
                                       const std::vector<std::string>& chosen) {
  if (chosen.empty()) return names;
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (std::find(names.begin(), names.end(), chosen[i]) != names.end()) continue;
    faults.push_back({"", "/scenes/" + std::to_string(i),
                      "expected the name of a scene of the recording, found " +
                          in_quotes(chosen[i]) + name_hint(chosen[i], names)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  const auto is_left_out = [&](const std::string& name) {
    return std::find(chosen.begin(), chosen.end(), name) == chosen.end();
  };
  names.erase(std::remove_if(names.begin(), names.end(), is_left_out), names.end());
  return names;
}

std::vector<Scene> with_file_errors(const std::function<std::vector<Scene>()>& read) {
  try {
    return read();
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().string(), "", error.code().message());
  }
}

bool SceneOrder::operator()(const std::string& a, const std::string& b) const {
  // Numbers of any length: without leading zeros, the longer one is larger.
  const auto key = [](const std::string& name) {
    const bool is_number = name.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t first = is_number ? std::min(name.find_first_not_of('0'), name.size()) : 0;
    return std::tuple(!is_number, is_number ? name.size() - first : 0, name.substr(first), name);
  };
  return key(a) < key(b);
}

std::string why_no_scan_name(const std::string& name, const std::string& what) {
  constexpr std::size_t kMaxStemBytes = kMaxFileNameBytes - std::string_view(".pcd").size();
  const std::string too_long = why_too_long(name, kMaxStemBytes, what + " with a name");
  if (!too_long.empty()) return too_long;
  const bool is_fine = !name.empty() && printable(name) == name &&
                       (std::string(kFormulaSigns) + ".").find(name.front()) == std::string::npos &&
                       name.find('/') == std::string::npos;
  if (is_fine) return "";
  return "expected " + what +
         " with a name in UTF-8 without slashes and control characters that does not begin with "
         "= + - @ or a dot, found " +
         in_quotes(name);
}

}  // namespace croon
