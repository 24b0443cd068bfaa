#include "experiments/store/provenance.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/file/experiment.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/trial_plan.hpp"
#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/io/digest.hpp"
#include "framework/params/values.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;
using params::value_json;

/// `file` relative to the data root if it is below it; else unchanged.
std::string relative_path(const std::string& file, const fs::path& data_root) {
  std::error_code error;
  const fs::path relative = fs::relative(file, data_root, error);
  const bool is_below = !error && !relative.empty() && *relative.begin() != "..";
  return is_below ? relative.generic_string() : file;
}

/// The scans that are read from files, each file once.
std::vector<const SensorScan*> scans_with_files(const std::vector<Scene>& scenes) {
  std::vector<const SensorScan*> scans;
  std::set<std::string> files = {""};
  const auto add = [&](const SensorScan& scan) {
    if (files.insert(scan.file).second) scans.push_back(&scan);
  };
  for (const Scene& scene : scenes) {
    add(scene.reference);
    for (const SensorScan& scan : scene.sensors) add(scan);
  }
  return scans;
}

void count_points(const SensorScan& scan, InputFile& input) {
  try {
    const LoadedCloud cloud = scan.load();
    input.points = cloud.points.size();
    input.dropped_non_finite = cloud.dropped_non_finite;
  } catch (const InputError&) {
    // The trials fail and give the reason.
  }
}

/// The numbers of a pose, exact; "none" if there is no pose.
std::string pose_text(const std::optional<RigidTransform>& T) {
  if (!T) return "none";
  std::string text;
  for (int i = 0; i < 9; ++i) text += value_json(T->rotation(i / 3, i % 3)) + " ";
  for (int i = 0; i < 3; ++i) text += value_json(T->translation(i)) + " ";
  return text;
}

/// The digests of the files by path, and one digest of the rig's poses.
std::string inputs_json(const std::vector<Scene>& scenes, const std::vector<InputFile>& inputs) {
  nlohmann::json json = {{"files", nlohmann::json::object()}};
  for (const InputFile& input : inputs) json["files"][input.path] = input.sha256;
  std::string poses;
  for (const Scene& scene : scenes) {
    poses += scene.name + "\n" + scene.reference.sensor + "\n";
    for (const SensorScan& scan : scene.sensors) {
      if (is_pair(scan)) continue;  // Its poses follow from its sensors'.
      poses += scan.sensor + "\n" + pose_text(scan.truth) + "\n" + pose_text(scan.nominal) + "\n" +
               pose_text(scan.initial) + "\n";
    }
  }
  json["poses"] = sha256_of_text(poses);
  // A path may hold bytes that are not UTF-8.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::vector<InputFile> input_files(const std::vector<Scene>& scenes, const fs::path& data_root,
                                   int jobs) {
  const std::vector<const SensorScan*> scans = scans_with_files(scenes);
  std::vector<InputFile> inputs(scans.size());
  on_threads(jobs, [&] {
    for_each_in_parallel(scans.size(), [&](std::size_t i) {
      inputs[i].path = relative_path(scans[i]->file, data_root);
      inputs[i].sha256 = sha256_of_file(scans[i]->file);
      count_points(*scans[i], inputs[i]);
    });
  });
  return inputs;
}

Provenance provenance_of(const Experiment& experiment, const std::vector<Scene>& scenes,
                         const std::vector<InputFile>& inputs) {
  return {{"dataset", experiment.dataset.resolved()},
          {"inputs", inputs_json(scenes, inputs)},
          {"program", sha256_of_file("/proc/self/exe")},
          {"seed", std::to_string(experiment.seed)},
          {"starts", deciding_starts_json(experiment.starts)},
          {"success", success_json(experiment.success)}};
}

StoreHeader header_of(const Experiment& experiment, const std::vector<Scene>& scenes,
                      const Provenance& provenance, const std::string& manifest) {
  StoreHeader header{provenance, manifest, total_trials(experiment.starts), {}, {}, {}};
  for (const Variant& variant : experiment.variants) {
    header.variants.push_back({variant.name, variant.resolved});
  }
  for (const Scene& scene : scenes) header.scenes.push_back({scene.name, scene.kind});
  std::map<std::string, std::string> targets;
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      targets.emplace(scan.sensor, is_pair(scan) ? scan.target : scene.reference.sensor);
    }
  }
  for (const std::string& sensor : sensor_names(scenes)) {
    header.sensors.push_back({sensor, targets.at(sensor)});
  }
  return header;
}

}  // namespace croon::experiments
