#include "framework/calibration/recorded_scenes.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/calibration/pairing.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/io/recording_file.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/recording/recording.hpp"

namespace croon {
namespace {
namespace fs = std::filesystem;

/// One command-line input: the name of a sensor, empty if not given, and its path or topic.
struct Input {
  std::string name;
  std::string path;
};

/// The clouds of one sensor.
struct SensorClouds {
  std::string name;
  std::string other_name = {};  ///< The topic, an alternative name for --reference.
  std::vector<SensorScan> scans = {};
};

/// The clouds by sensor, and the data by which they are paired.
struct Recording {
  std::vector<SensorClouds> sensors;
  std::vector<SensorFiles> files = {};    ///< For pair_by_name.
  std::vector<SensorStamps> stamps = {};  ///< For pair_by_time.
  std::vector<PairedScene> paired = {};   ///< For a recording with one folder per scene.
  std::vector<std::string> unused = {};
};

Input input_of(const std::string& word) {
  const std::size_t sign = word.find('=');
  const bool is_named = sign != std::string::npos && word.find('/') > sign && !fs::exists(word);
  if (!is_named) return {"", word};
  const std::string name = word.substr(0, sign);
  const std::string why_not = why_no_scan_name(name, "a sensor");
  if (!why_not.empty()) throw InputError("", word, why_not);
  return {name, word.substr(sign + 1)};
}

/// Throws InputError, with the nearest path, if `path` does not exist.
void require_path(const std::string& path) {
  std::error_code error;
  if (!path.empty() && fs::exists(path, error)) return;
  const bool is_relative = fs::path(path).is_relative();
  throw InputError(
      path, "",
      "expected a cloud, a folder or a recording, found " + found_instead_of_file(path) +
          missing_path_hint(is_relative ? "" : "/",
                            is_relative ? fs::path(path) : fs::path(path).relative_path()));
}

bool is_bag(const fs::path& path) {
  return path.extension() == ".bag" || path.extension() == ".mcap" || path.extension() == ".db3" ||
         is_recording(path);
}

/// "left" for left.pcd and left.pcd.bin.
std::string name_of_file(const fs::path& path) {
  const fs::path stem = path.stem();
  return has_point_cloud_suffix(stem) ? stem.stem().string() : stem.string();
}

/// The name of a folder, whose path may end in a slash.
std::string name_of_folder(const fs::path& path) {
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return name == "." || name == ".." ? fs::canonical(path).filename().string() : name;
}

bool is_repeated(const std::vector<std::string>& names, std::size_t index) {
  return std::count(names.begin(), names.end(), names[index]) > 1;
}

/// Throws InputError if two sensors have the same name, or if a name is not valid in a file name.
void check_names(const std::vector<std::string>& names, const std::vector<Input>& inputs) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string why_not = why_no_scan_name(names[i], "a sensor");
    if (!why_not.empty()) throw InputError(inputs[i].path, "", why_not + "; name it: NAME=PATH");
    if (!is_repeated(names, i)) continue;
    throw InputError(inputs[i].path, "",
                     "expected sensors with distinct names, found two named " +
                         in_quotes(names[i]) + "; name them: NAME=PATH");
  }
}

/// The names of sensors with a file each; files with the same name are named after their folders.
std::vector<std::string> names_of_files(const std::vector<Input>& inputs) {
  std::vector<std::string> stems, names;
  for (const Input& input : inputs) {
    stems.push_back(input.name.empty() ? name_of_file(input.path) : input.name);
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool is_unclear = inputs[i].name.empty() && is_repeated(stems, i);
    names.push_back(is_unclear ? name_of_folder(fs::absolute(inputs[i].path).parent_path())
                               : stems[i]);
  }
  check_names(names, inputs);
  return names;
}

void refuse_same_paths(const std::vector<Input>& inputs) {
  std::map<fs::path, std::string> known;
  for (const Input& input : inputs) {
    const auto [found, is_new] = known.emplace(fs::canonical(input.path), input.path);
    if (is_new) continue;
    throw InputError(input.path, "",
                     "expected a different path for each sensor, found the path of " +
                         in_quotes(found->second) + " again");
  }
}

/// A recording of one scene, with a file per sensor.
Recording recording_of_files(const std::vector<Input>& inputs) {
  Recording recording;
  const std::vector<std::string> names = names_of_files(inputs);
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    collect_faults(faults, [&] {
      recording.sensors.push_back({names[i], "", {scan_in_file(names[i], inputs[i].path)}});
      recording.files.push_back({names[i], inputs[i].path, {inputs[i].path}});
    });
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return recording;
}

/// The sorted clouds in `folder`; if suffixes differ, only those with the most frequent one.
std::vector<fs::path> clouds_in(const fs::path& folder) {
  std::map<std::string, std::vector<fs::path>> by_suffix;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && has_point_cloud_suffix(entry.path())) {
      by_suffix[entry.path().extension().string()].push_back(entry.path());
    }
  }
  std::vector<fs::path> clouds;
  for (auto& [suffix, paths] : by_suffix) {
    if (paths.size() > clouds.size()) clouds = std::move(paths);
  }
  std::sort(clouds.begin(), clouds.end());
  return clouds;
}

/// A recording with a folder per sensor.
Recording recording_of_folders(const std::vector<Input>& inputs) {
  Recording recording;
  std::vector<std::string> names;
  for (const Input& input : inputs) {
    names.push_back(input.name.empty() ? name_of_folder(input.path) : input.name);
  }
  check_names(names, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    recording.files.push_back({names[i], inputs[i].path, clouds_in(inputs[i].path)});
    recording.sensors.push_back({names[i]});
    for (const fs::path& file : recording.files.back().files) {
      recording.sensors.back().scans.push_back(scan_on_demand(names[i], file));
    }
  }
  return recording;
}

bool is_numbered(const std::string& name) {
  return name.find_first_not_of("0123456789._-") == std::string::npos;
}

/// Whether the folders are scenes: their names are numbers and those of their files are not.
bool are_scenes(const std::vector<Input>& folders) {
  return std::all_of(folders.begin(), folders.end(), [](const Input& folder) {
    const std::vector<fs::path> files = clouds_in(folder.path);
    return is_numbered(name_of_folder(folder.path)) &&
           std::none_of(files.begin(), files.end(),
                        [](const fs::path& file) { return is_numbered(name_of_file(file)); });
  });
}

/// A recording with a folder per scene, and in it a file per sensor.
Recording recording_of_scene_folders(const std::vector<Input>& folders) {
  std::set<std::string> names;
  for (const Input& folder : folders) {
    for (const fs::path& file : clouds_in(folder.path)) names.insert(name_of_file(file));
  }
  Recording recording;
  for (const std::string& name : names) {
    recording.sensors.push_back({name});
  }
  for (const Input& folder : folders) {
    PairedScene scene{name_of_folder(folder.path), {}};
    scene.clouds.resize(names.size());
    for (const fs::path& file : clouds_in(folder.path)) {
      const auto i =
          static_cast<std::size_t>(std::distance(names.begin(), names.find(name_of_file(file))));
      SensorClouds& sensor = recording.sensors[i];
      scene.clouds[i] = sensor.scans.size();
      sensor.scans.push_back(scan_on_demand(sensor.name, file));
    }
    recording.paired.push_back(std::move(scene));
  }
  return recording;
}

/// The scenes with clouds of the reference and of another sensor, and a line for each other scene.
Pairing with_reference(const std::vector<PairedScene>& scenes, std::size_t reference) {
  Pairing pairing;
  for (const PairedScene& scene : scenes) {
    const auto missing = std::count(scene.clouds.begin(), scene.clouds.end(), std::nullopt);
    if (scene.clouds[reference] && scene.clouds.size() - static_cast<std::size_t>(missing) > 1) {
      pairing.scenes.push_back(scene);
    } else {
      pairing.unpaired.push_back("Scene " + scene.name +
                                 " lacks the reference or all other sensors.");
    }
  }
  return pairing;
}

/// The recording in the folder of a rig, with a folder per sensor or per scene.
Recording recording_of_rig_folder(const fs::path& folder) {
  std::vector<Input> inputs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && !clouds_in(entry.path()).empty()) {
      inputs.push_back({"", entry.path().string()});
    }
  }
  std::sort(inputs.begin(), inputs.end(),
            [](const Input& a, const Input& b) { return a.path < b.path; });
  if (!inputs.empty() && are_scenes(inputs)) return recording_of_scene_folders(inputs);
  if (inputs.size() >= 2) return recording_of_folders(inputs);
  const std::size_t clouds = clouds_in(folder).size();
  throw InputError(folder.string(), "",
                   "expected a folder with a folder of clouds for each sensor, found " +
                       counted(inputs.size(), "such folder") + " and " + counted(clouds, "cloud") +
                       (clouds >= 2 ? "; name a file for each sensor" : ""));
}

std::vector<std::string> parts_of_topic(const std::string& topic) {
  std::vector<std::string> parts(1);
  for (const char c : topic) {
    if (c != '/') {
      parts.back() += c;
    } else if (!parts.back().empty()) {
      parts.emplace_back();
    }
  }
  if (parts.back().empty() && parts.size() > 1) parts.pop_back();
  return parts;
}

/// Names sensors after the parts in which their topics differ: "top" for /top/points.
std::vector<std::string> names_of_topics(const std::vector<std::string>& topics) {
  std::map<std::string, std::size_t> topics_with;
  std::vector<std::string> names;
  for (const std::string& topic : topics) {
    const std::vector<std::string> parts = parts_of_topic(topic);
    for (const auto& part : std::set<std::string>(parts.begin(), parts.end())) ++topics_with[part];
  }
  for (const std::string& topic : topics) {
    std::string whole, name;
    for (const std::string& part : parts_of_topic(topic)) {
      whole += (whole.empty() ? "" : "_") + part;
      if (topics_with[part] < topics.size()) name += (name.empty() ? "" : "_") + part;
    }
    names.push_back(name.empty() ? whole : name);
  }
  return names;
}

/// The topics named in `inputs`, or all if it is empty, with names of sensors.
std::vector<Input> chosen_topics(const std::vector<CloudTopic>& topics,
                                 const std::vector<Input>& inputs, const std::string& file) {
  std::vector<std::string> known;
  for (const CloudTopic& topic : topics) known.push_back(topic.name);
  std::vector<Input> chosen = inputs;
  if (chosen.empty()) {
    for (const std::string& name : known) chosen.push_back({"", name});
  }
  std::vector<std::string> paths;
  for (const Input& input : chosen) {
    paths.push_back(input.path);
    if (std::find(known.begin(), known.end(), input.path) != known.end()) continue;
    throw InputError(file, "",
                     "expected a topic with point clouds, found " + in_quotes(input.path) +
                         name_hint(input.path, known));
  }
  const std::vector<std::string> names = names_of_topics(paths);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i].name.empty()) chosen[i].name = names[i];
  }
  return chosen;
}

/// The recording in the topics of a rosbag2.
Recording recording_of_bag(const std::string& bag, const std::vector<Input>& inputs) {
  Recording recording;
  const std::vector<CloudTopic> topics = read_recording(bag, &recording.unused);
  const std::vector<Input> chosen = chosen_topics(topics, inputs, bag);
  std::vector<std::string> names;
  for (const Input& input : chosen) names.push_back(input.name);
  check_names(names, chosen);
  for (const Input& input : chosen) {
    const auto topic = std::find_if(topics.begin(), topics.end(), [&](const CloudTopic& other) {
      return other.name == input.path;
    });
    recording.sensors.push_back({input.name, topic->name});
    recording.stamps.push_back({input.name, {}});
    for (const RecordedCloud& cloud : topic->clouds) {
      SensorScan scan;
      scan.sensor = input.name;
      scan.load = cloud.load;
      recording.sensors.back().scans.push_back(std::move(scan));
      recording.stamps.back().stamps_s.push_back(cloud.stamp_s);
    }
  }
  return recording;
}

/// The recording in files or in folders. Throws InputError if they are mixed.
Recording recording_of_paths(const std::vector<Input>& inputs) {
  refuse_same_paths(inputs);
  const auto is_folder = [](const Input& input) { return fs::is_directory(input.path); };
  const auto folders = std::count_if(inputs.begin(), inputs.end(), is_folder);
  if (folders == 0) return recording_of_files(inputs);
  if (static_cast<std::size_t>(folders) == inputs.size()) return recording_of_folders(inputs);
  const auto file = std::find_if_not(inputs.begin(), inputs.end(), is_folder);
  throw InputError(file->path, "",
                   "expected a folder, as for other sensors, found a file: name either a file or a "
                   "folder for every sensor");
}

Recording recording_of(const std::vector<Input>& inputs) {
  if (inputs.empty()) {
    throw InputError("", "",
                     "expected clouds, folders of clouds or a recording to calibrate, found none");
  }
  const Input& first = inputs.front();
  require_path(first.path);
  if (is_bag(first.path)) return recording_of_bag(first.path, {inputs.begin() + 1, inputs.end()});
  for (const Input& input : inputs) {
    require_path(input.path);
    if (!is_bag(input.path)) continue;
    throw InputError(input.path, "",
                     "expected a recording as the first input, followed by its topics");
  }
  if (inputs.size() > 1) return recording_of_paths(inputs);
  if (fs::is_directory(first.path)) return recording_of_rig_folder(first.path);
  throw InputError(first.path, "",
                   "expected clouds of at least two sensors, found one; the first is the "
                   "reference, to which the others are calibrated");
}

/// The index of the sensor `reference`. Throws InputError, with the nearest name, if missing.
std::size_t reference_index(const Recording& recording, const std::string& reference) {
  if (reference.empty()) return 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < recording.sensors.size(); ++i) {
    const SensorClouds& sensor = recording.sensors[i];
    if (sensor.name == reference || sensor.other_name == reference) return i;
    names.push_back(sensor.name);
    if (!sensor.other_name.empty()) names.push_back(sensor.other_name);
  }
  throw InputError(
      "", "--reference",
      "expected a sensor, found " + in_quotes(reference) + name_hint(reference, names));
}

Scene scene_of(const Recording& recording, const PairedScene& paired, std::size_t reference) {
  Scene scene;
  scene.name = paired.name;
  for (std::size_t i = 0; i < recording.sensors.size(); ++i) {
    if (!paired.clouds[i]) continue;
    const SensorScan& scan = recording.sensors[i].scans[*paired.clouds[i]];
    if (i == reference) {
      scene.reference = scan;
    } else {
      scene.sensors.push_back(scan);
    }
  }
  return scene;
}

/// Keeps at most `count` of the scenes, evenly spaced.
void thin_out(std::vector<PairedScene>& scenes, int count, std::vector<std::string>& unused) {
  const std::size_t all = scenes.size();
  const auto kept = static_cast<std::size_t>(count);
  if (all <= kept) return;
  for (std::size_t i = 0; i < kept; ++i) scenes[i] = scenes[i * all / kept];
  scenes.resize(kept);
  unused.push_back(counted(all - kept, "scene") + " of " + std::to_string(all) + ": only " +
                   std::to_string(kept) + ", evenly spaced, are used (see the option max-scenes).");
}

}  // namespace

SensorScan scan_on_demand(const std::string& sensor, const fs::path& file) {
  SensorScan scan;
  scan.sensor = sensor;
  scan.file = file.string();
  scan.load = [file] { return read_point_cloud(file); };
  return scan;
}

RecordedScenes recorded_scenes(const std::vector<std::string>& words,
                               const RecordingOptions& options) {
  std::vector<Input> inputs;
  for (const std::string& word : words) inputs.push_back(input_of(word));
  const Recording recording = recording_of(inputs);
  if (recording.sensors.size() < 2) {
    throw InputError(inputs.front().path, "",
                     "expected clouds of at least two sensors, found only " +
                         in_quotes(recording.sensors.front().name));
  }
  const std::size_t reference = reference_index(recording, options.reference);
  const std::string& name = recording.sensors[reference].name;
  Pairing pairing = !recording.paired.empty() ? with_reference(recording.paired, reference)
                    : recording.stamps.empty()
                        ? pair_by_name(recording.files, name, options.max_time_gap_s)
                        : pair_by_time(recording.stamps, name, options.max_time_gap_s);
  RecordedScenes result;
  result.unused = recording.unused;
  result.unused.insert(result.unused.end(), pairing.unpaired.begin(), pairing.unpaired.end());
  if (pairing.scenes.empty()) {
    std::vector<Fault> faults = {
        {inputs.front().path, "",
         "expected clouds of " + in_quotes(name) +
             " and of another sensor at the same time, found none within " +
             plain_number(options.max_time_gap_s) + " s (see the option max-time-gap)"}};
    for (const std::string& line : result.unused) faults.push_back({"", "", line});
    throw InputError(std::move(faults));
  }
  thin_out(pairing.scenes, options.max_scenes, result.unused);
  for (const PairedScene& paired : pairing.scenes) {
    result.scenes.push_back(scene_of(recording, paired, reference));
  }
  return result;
}

}  // namespace croon
