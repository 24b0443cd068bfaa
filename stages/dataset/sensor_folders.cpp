#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/params/repeats.hpp"
#include "framework/recording/recording.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::dataset {
namespace {

namespace fs = std::filesystem;

struct Params {
  std::string path;
  std::string reference;
  std::vector<std::string> sensors;
  std::vector<std::string> scenes;
  bool follow_links = false;
};

/// Adds a fault for each invalid or duplicate name, and for a sensor that is the reference.
void check_names(const Params& params, const params::Node& node) {
  const auto check_name = [](const std::string& name, const params::Node& at) {
    const std::string why_not = why_no_scan_name(name, "a sensor");
    if (!why_not.empty()) at.fault(why_not);
  };
  params::refuse_repeats(params.scenes, node, "scenes");
  params::refuse_repeats(params.sensors, node, "sensors");
  check_name(params.reference, node.member("reference"));
  for (std::size_t i = 0; i < params.sensors.size(); ++i) {
    check_name(params.sensors[i], node.member("sensors").element(i));
    if (params.sensors[i] != params.reference) continue;
    node.member("sensors").element(i).fault("expected another sensor than the reference, found " +
                                            in_quotes(params.sensors[i]));
  }
}

params::Table<Params> make_table() {
  params::Table<Params> table = {
      params::text("path", &Params::path,
                   "Folder that contains a folder for each sensor, relative to the data root."),
      params::text("reference", &Params::reference,
                   "Folder of the reference, to which the other sensors are calibrated."),
      params::texts("sensors", &Params::sensors,
                    "Folders of the other sensors, in this order; an empty list means every folder "
                    "with clouds."),
      params::texts("scenes", &Params::scenes, kScenesDoc),
      params::boolean("follow_links", &Params::follow_links,
                      "Whether symbolic links may point outside the data root."),
  };
  return table.finish(check_names);
}

const params::Table<Params>& table() {
  static const params::Table<Params> table = make_table();
  return table;
}

/// The clouds of one sensor by their names without suffix.
using Clouds = std::map<std::string, fs::path, SceneOrder>;

/// Throws InputError for a dangling link, for example to a disk that is not mounted: its target
/// must not be skipped silently.
void refuse_dangling(const fs::directory_entry& entry) {
  if (!entry.is_symlink() || entry.exists()) return;
  throw InputError(entry.path().string(), "", "expected a file or folder, found a dangling link");
}

/// The clouds in `folder`. Throws InputError if two have the same name.
Clouds clouds_in(const SceneLocation& folder) {
  Clouds clouds;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.folder)) {
    if (!looks_like_point_cloud(entry.path())) continue;
    refuse_dangling(entry);
    if (!entry.is_regular_file()) {
      throw InputError(entry.path().string(), "",
                       "expected a cloud, found " + found_instead_of_file(entry.path()));
    }
    const fs::path file = path_in_data_root(folder.root, entry.path().string(), folder.links);
    const auto [found, is_new] = clouds.emplace(entry.path().stem().string(), file);
    if (is_new) continue;
    throw InputError(entry.path().string(), "",
                     "expected one cloud of this name, also found " + found->second.string());
  }
  return clouds;
}

std::vector<std::string> names_of(const Clouds& clouds) {
  std::vector<std::string> names;
  for (const auto& [name, file] : clouds) names.push_back(name);
  return names;
}

/// The sorted names of the folders in `rig` that contain clouds, without `reference` unless that is
/// empty.
std::vector<std::string> other_folders(const fs::path& rig, const std::string& reference) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(rig)) {
    refuse_dangling(entry);
    if (!entry.is_directory() || entry.path().filename() == reference) continue;
    const fs::directory_iterator files(entry.path());
    if (std::any_of(fs::begin(files), fs::end(files), [](const fs::directory_entry& file) {
          return looks_like_point_cloud(file.path());
        })) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A recording with a folder of clouds for each sensor. Clouds of the same name form a scene.
class SensorFolders final : public Dataset {
 public:
  explicit SensorFolders(Params params) : params_(std::move(params)) {}

  std::vector<Scene> scenes(const fs::path& data_root) const override {
    return with_file_errors([&] { return read_scenes(data_root); });
  }

 private:
  std::vector<Scene> read_scenes(const fs::path& data_root) const {
    SceneLocation rig;
    rig.links = params_.follow_links ? Links::anywhere : Links::inside;
    rig.folder = path_in_data_root(data_root, params_.path, rig.links, "/path");
    rig.root = fs::canonical(data_root);
    check_folders(rig.folder);
    std::vector<std::string> names = params_.sensors;
    if (names.empty()) names = other_folders(rig.folder, params_.reference);
    const Clouds references = clouds_of(rig, params_.reference);
    std::map<std::string, Clouds> clouds;
    for (const std::string& name : names) clouds[name] = clouds_of(rig, name);
    std::vector<Scene> scenes;
    std::vector<Fault> faults;
    RigFilesAbove rig_files;
    std::vector<std::string> frames = names_of(references);
    // A reference cloud without a counterpart in any other folder forms no scene.
    const auto is_alone = [&](const std::string& frame) {
      return std::none_of(names.begin(), names.end(), [&](const std::string& name) {
        return clouds.at(name).count(frame) > 0;
      });
    };
    frames.erase(std::remove_if(frames.begin(), frames.end(), is_alone), frames.end());
    for (const std::string& frame : chosen_scenes(std::move(frames), params_.scenes)) {
      const fs::path& file = references.at(frame);
      Scene scene;
      scene.name = rig.name = frame;
      for (const std::string& name : names) {
        const auto found = clouds.at(name).find(frame);
        if (found == clouds.at(name).end()) continue;
        collect_faults(faults, [&] { scene.sensors.push_back(scan_in_file(name, found->second)); });
      }
      collect_faults(faults, [&] { scene.reference = scan_in_file(params_.reference, file); });
      collect_faults(faults, [&] { rig_files.complete(scene, rig); });
      scenes.push_back(std::move(scene));
    }
    if (!faults.empty()) throw InputError(without_repeats(faults));
    if (!scenes.empty()) return scenes;
    throw InputError(rig.folder.string(), "",
                     "expected clouds of the same name in the folder \"" + params_.reference +
                         "\" and in another one, found none");
  }

  /// Throws InputError, with JSON pointers to the parameters, if the folder of a sensor is missing.
  void check_folders(const fs::path& rig) const {
    std::vector<Fault> faults;
    const auto check = [&](const std::string& pointer, const std::string& name) {
      if (fs::exists(rig / name)) return;
      faults.push_back({"", pointer,
                        "expected the folder of a sensor, found no " + (rig / name).string() +
                            name_hint(name, other_folders(rig, ""))});
    };
    check("/reference", params_.reference);
    for (std::size_t i = 0; i < params_.sensors.size(); ++i) {
      check("/sensors/" + std::to_string(i), params_.sensors[i]);
    }
    if (!faults.empty()) throw InputError(std::move(faults));
  }

  static Clouds clouds_of(const SceneLocation& rig, const std::string& name) {
    SceneLocation folder = rig;
    folder.folder = path_in_data_root(rig.root, (rig.folder / name).string(), rig.links);
    if (!fs::is_directory(folder.folder)) {
      throw InputError(folder.folder.string(), "", "expected the folder of a sensor");
    }
    return clouds_in(folder);
  }

  Params params_;
};

}  // namespace

StageEntry sensor_folders() {
  return stage_entry<SensorFolders>(
      "sensor_folders",
      "Recordings with a folder of clouds for each sensor; clouds of the same name form a scene.",
      "croon", table());
}

}  // namespace croon::stages::dataset
