#include "framework/calibration/scene_stream.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "framework/calibration/loaded_scene.hpp"
#include "framework/calibration/pairing.hpp"
#include "framework/io/point_cloud_file.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// A file is complete if its header and size are right and it has not changed for so long: a part
/// of some formats is a cloud too.
constexpr double kSettled_s = 0.3;

/// Maximum number of names of each sensor in memory.
constexpr std::size_t kAhead = 512;

void keep_first(std::vector<fs::path>& files) {
  if (files.size() <= kAhead) return;
  std::nth_element(files.begin(), files.begin() + kAhead, files.end());
  files.resize(kAhead);
}

/// The time since the file changed; infinite if that is unknown or in the future.
double age_s(const fs::path& file) {
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  const double age =
      std::chrono::duration<double>(fs::file_time_type::clock::now() - changed).count();
  return error || age < 0.0 ? std::numeric_limits<double>::infinity() : age;
}

/// Whether the file is still being written.
bool is_unfinished(const fs::path& file) {
  const double age = age_s(file);
  if (age < kSettled_s) return true;
  if (age >= SceneStream::kPatience_s) return false;
  try {
    check_point_cloud_file(file);
  } catch (const InputError&) {
    return true;
  }
  return false;
}

/// The folders of the reference and of the other sensors, if each has its own.
std::vector<std::pair<std::string, fs::path>> folders_of(const std::vector<Scene>& scenes) {
  std::map<std::string, fs::path> by_sensor;
  std::set<fs::path> different;
  const auto add = [&](const SensorScan& scan) {
    const fs::path folder = fs::path(scan.file).parent_path();
    if (by_sensor.emplace(scan.sensor, folder).second) different.insert(folder);
    return !scan.file.empty() && by_sensor.at(scan.sensor) == folder;
  };
  for (const Scene& scene : scenes) {
    bool is_own = add(scene.reference);
    for (const SensorScan& scan : scene.sensors) is_own = add(scan) && is_own;
    if (!is_own) return {};
  }
  if (different.size() < by_sensor.size()) return {};
  const std::string& reference = scenes.front().reference.sensor;
  std::vector<std::pair<std::string, fs::path>> folders = {{reference, by_sensor.at(reference)}};
  for (const std::string& name : sensor_names(scenes))
    folders.emplace_back(name, by_sensor.at(name));
  return folders;
}

/// Whether the files form a single scene that was named file by file.
bool is_one_scene_of_files(const std::vector<Scene>& scenes) {
  return scenes.size() == 1 &&
         std::any_of(scenes.front().sensors.begin(), scenes.front().sensors.end(),
                     [&](const SensorScan& scan) {
                       return fs::path(scan.file).stem() !=
                                  fs::path(scenes.front().reference.file).stem() &&
                              !stamp_in_name(fs::path(scan.file).stem().string());
                     });
}

}  // namespace

SceneStream::SceneStream(RecordedScenes recorded, double max_time_gap_s)
    : recorded_(std::move(recorded)),
      max_time_gap_s_(max_time_gap_s),
      reference_(recorded_.scenes.front().reference.sensor),
      sensors_(sensor_names(recorded_.scenes)) {
  if (is_one_scene_of_files(recorded_.scenes)) return;
  for (auto& [sensor, path] : folders_of(recorded_.scenes)) folders_.push_back({sensor, path, ""});
  if (folders_.empty()) return;
  for (Folder& folder : folders_) {
    for (const Scene& scene : recorded_.scenes) {
      for (std::size_t i = 0; i <= scene.sensors.size() && folder.suffix.empty(); ++i) {
        const SensorScan& scan = scan_at(scene, i);
        if (scan.sensor == folder.sensor) folder.suffix = fs::path(scan.file).extension().string();
      }
    }
  }
  recorded_.unused.clear();
  recorded_.scenes.clear();
  recorded_.scenes.shrink_to_fit();
}

std::optional<std::size_t> SceneStream::size() const {
  return is_growing() ? std::nullopt : std::make_optional(recorded_.scenes.size());
}

std::optional<Scene> SceneStream::next() {
  if (is_growing()) return next_in_folders();
  if (next_ == recorded_.scenes.size()) return std::nullopt;
  return std::move(recorded_.scenes[next_++]);
}

void SceneStream::list(Folder& folder) {
  folder.files.clear();
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path, error)) {
    const fs::path& file = entry.path();
    const bool is_new = file.filename().string() > folder.last_name;
    if (!is_new || file.extension() != folder.suffix || !entry.is_regular_file(error)) continue;
    folder.files.push_back(file);
    if (folder.files.size() == 2 * kAhead) keep_first(folder.files);
  }
  keep_first(folder.files);
  std::sort(folder.files.begin(), folder.files.end());
}

fs::path SceneStream::match(const Folder& folder, const fs::path& reference) const {
  const std::optional<double> stamp_s = stamp_in_name(reference.stem().string());
  fs::path nearest;
  double min_gap_s = std::numeric_limits<double>::infinity();
  for (const fs::path& file : folder.files) {
    if (file.stem() == reference.stem()) return file;
    const std::optional<double> other_s = stamp_in_name(file.stem().string());
    if (!stamp_s || !other_s) continue;
    const double gap_s = std::abs(*other_s - *stamp_s);
    if (gap_s > max_time_gap_s_ || gap_s >= min_gap_s) continue;
    min_gap_s = gap_s;
    nearest = file;
  }
  return nearest;
}

std::optional<Scene> SceneStream::next_in_folders() {
  if (folders_.front().files.empty()) list(folders_.front());
  if (folders_.front().files.empty()) return std::nullopt;
  const fs::path reference = folders_.front().files.front();
  Scene scene;
  scene.name = reference.stem().string();
  scene.reference = scan_on_demand(folders_.front().sensor, reference);
  bool is_waiting = is_unfinished(reference);
  std::vector<fs::path> used = {reference};
  for (std::size_t i = 1; i < folders_.size(); ++i) {
    used.push_back(match(folders_[i], reference));
    if (used.back().empty()) {
      list(folders_[i]);
      used.back() = match(folders_[i], reference);
    }
    if (used.back().empty()) {
      is_waiting = is_waiting || age_s(reference) < kPatience_s;
    } else {
      is_waiting = is_waiting || is_unfinished(used.back());
      scene.sensors.push_back(scan_on_demand(folders_[i].sensor, used.back()));
    }
  }
  if (is_waiting) return std::nullopt;
  for (std::size_t i = 0; i < folders_.size(); ++i) {
    Folder& folder = folders_[i];
    if (used[i].empty()) continue;
    folder.last_name = used[i].filename().string();
    folder.files.erase(folder.files.begin(),
                       std::upper_bound(folder.files.begin(), folder.files.end(), used[i]));
  }
  return scene;
}

}  // namespace croon
