#include "experiments/store/manifest.hpp"

#include <sys/utsname.h>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "experiments/file/experiment.hpp"
#include "experiments/run/trial_plan.hpp"
#include "experiments/store/bounded_json.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/params/values.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json files_json(const std::vector<ExperimentFile>& files) {
  Json json = Json::array();
  for (const ExperimentFile& file : files) {
    const Json entry = {{"path", file.path}, {"sha256", file.sha256}};
    if (std::find(json.begin(), json.end(), entry) == json.end()) json.push_back(entry);
  }
  return json;
}

Json listed_inputs(const std::vector<InputFile>& inputs) {
  Json json = Json::array();
  for (const InputFile& input : inputs) {
    Json file = {{"path", input.path}, {"sha256", input.sha256}};
    if (input.points) {
      file["points"] = *input.points;
      file["dropped_non_finite"] = *input.dropped_non_finite;
    }
    json.push_back(file);
  }
  return json;
}

constexpr const char* kWithoutTruth = "sensors_without_truth";

/// More trials than any run has; products with this number do not overflow.
constexpr std::size_t kMaxPlanned = 1'000'000'000'000;

/// One variant's line in the text from which the digest of the pipelines is computed.
std::string pipeline_line(const std::string& name, const std::string& resolved) {
  return name + "\n" + resolved + "\n";
}

std::string pipelines_text(const Experiment& experiment) {
  std::string text;
  for (const Variant& variant : experiment.variants) {
    text += pipeline_line(variant.name, pipeline_json(variant.pipeline).dump());
  }
  return text;
}

std::size_t planned_trials(const Experiment& experiment, const std::vector<SceneGroup>& groups) {
  std::size_t sensors = 0;
  for (const SceneGroup& group : groups) sensors += group.pairs.size();
  return sensors * static_cast<std::size_t>(total_trials(experiment.starts)) *
         experiment.variants.size();
}

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 10, "model name") == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

Json host_json(const std::filesystem::path& data_root, int jobs) {
  utsname system{};
  uname(&system);
  return {{"hostname", system.nodename},
          {"os", std::string(system.sysname) + " " + system.release + " " + system.machine},
          {"cpu", cpu_model()},
          {"cores", std::thread::hardware_concurrency()},
          {"jobs", jobs},
          {"data_root", data_root.string()},
          {"started", utc_time()}};
}

namespace fs = std::filesystem;
using params::value_json;

/// The exact numbers of a pose; "none" if there is no pose.
std::string pose_text(const std::optional<RigidTransform>& T) {
  if (!T) return "none";
  std::string text;
  for (int i = 0; i < 9; ++i) text += value_json(T->rotation(i / 3, i % 3)) + " ";
  for (int i = 0; i < 3; ++i) text += value_json(T->translation(i)) + " ";
  return text;
}

/// The digests of the files by path, and one digest of the rig's poses.
std::string deciding_inputs_json(const std::vector<SceneGroup>& groups,
                                 const std::vector<InputFile>& inputs) {
  nlohmann::json json = {{"files", nlohmann::json::object()}};
  for (const InputFile& input : inputs) json["files"][input.path] = input.sha256;
  std::string poses;
  for (const SceneGroup& group : groups) {
    for (const Scene& scene : group.scenes) {
      poses += scene.name + "\n" + scene.reference.sensor + "\n";
      // The poses of pairs of sensors follow from these.
      for (const SensorScan& scan : scene.sensors) {
        poses += scan.sensor + "\n" + pose_text(scan.truth) + "\n" + pose_text(scan.nominal) +
                 "\n" + pose_text(scan.initial) + "\n";
      }
    }
  }
  json["poses"] = sha256_of_text(poses);
  // A path may contain bytes that are not UTF-8.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The names of the scenes in each group.
Json groups_json(const std::vector<SceneGroup>& groups) {
  Json json = Json::object();
  for (const SceneGroup& group : groups) {
    for (const Scene& scene : group.scenes) json[group.name].push_back(scene.name);
  }
  return json;
}

/// The sensors without ground truth in any scene.
std::vector<std::string> without_truth(const std::vector<SceneGroup>& groups) {
  std::set<std::string> with_truth;
  for (const SceneGroup& group : groups) {
    for (const CalibratedPair& pair : group.pairs) {
      if (pair.truth) with_truth.insert(pair.name);
    }
  }
  std::vector<std::string> sensors = sensor_names(groups);
  const auto has_truth = [&](const std::string& sensor) { return with_truth.count(sensor) > 0; };
  sensors.erase(std::remove_if(sensors.begin(), sensors.end(), has_truth), sensors.end());
  return sensors;
}

}  // namespace

std::string utc_time() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

std::string manifest_json(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                          const std::vector<InputFile>& inputs, const Provenance& provenance) {
  Json manifest;
  manifest["experiment"] = experiment_json(experiment);
  manifest["experiment_files"] = files_json(experiment.files);
  if (experiment.scenes_per_trial > 1) manifest["groups"] = groups_json(groups);
  manifest["inputs"] = listed_inputs(inputs);
  manifest["provenance"] = {{"inputs", sha256_of_text(provenance.at("inputs"))},
                            {"pipelines", sha256_of_text(pipelines_text(experiment))}};
  manifest["planned"] = planned_trials(experiment, groups);
  const std::vector<std::string> sensors = without_truth(groups);
  if (!sensors.empty()) manifest[kWithoutTruth] = sensors;
  return json_bytes(manifest);
}

std::size_t planned_trials(const std::string& manifest) {
  const Json planned = parse_bounded<Json>(manifest).at("planned");
  if (!planned.is_number_unsigned() || planned > kMaxPlanned) {
    throw std::runtime_error("\"planned\" of its manifest is not a number of trials");
  }
  return planned;
}

std::set<std::string> sensors_without_truth(const std::string& manifest) {
  const Json json = parse_bounded<Json>(manifest);
  const auto found = json.find(kWithoutTruth);
  return found == json.end() ? std::set<std::string>() : found->get<std::set<std::string>>();
}

std::size_t planned_trials_of_variant(const std::string& manifest) {
  const Json variants = parse_bounded<Json>(manifest).at("experiment").at("variants");
  if (!variants.is_array() || variants.empty()) {
    throw std::runtime_error("its manifest has no variants");
  }
  return planned_trials(manifest) / variants.size();
}

std::string manifest_with_variants(const std::string& manifest,
                                   const std::vector<StoredName>& variants) {
  Json json = parse_bounded<Json>(manifest);
  Json& described = json.at("experiment").at("variants");
  const std::size_t trials_of_one = planned_trials_of_variant(manifest);
  described = Json::array();
  std::string pipelines;
  for (const StoredName& variant : variants) {
    if (!variant.is_current) continue;
    described.push_back(
        {{"name", variant.name}, {"pipeline", parse_bounded<Json>(variant.detail)}});
    pipelines += pipeline_line(variant.name, variant.detail);
  }
  json["provenance"]["pipelines"] = sha256_of_text(pipelines);
  json["planned"] = trials_of_one * described.size();
  return json_bytes(json);
}

std::string manifest_with_host(const std::string& manifest, const std::filesystem::path& data_root,
                               int jobs) {
  Json json = parse_bounded<Json>(manifest);
  json["host"] = host_json(data_root, jobs);
  return json_bytes(json);
}

std::string hosts_json(const std::vector<std::filesystem::path>& folders) {
  Json merged = Json::array();
  for (const std::filesystem::path& folder : folders) {
    const std::optional<std::string> file = read_file_if_there(folder / "manifest.json");
    if (!file) continue;
    const Json other = parsed_or_discarded<Json>(*file);
    const auto host = other.find("host");
    // Results of a merge already list several hosts.
    const bool is_list = host != other.end() && host->is_object() && host->contains("merged");
    if (host == other.end() || !host->is_object() || (is_list && !host->at("merged").is_array())) {
      throw InputError(
          (folder / "manifest.json").string(), "",
          "is damaged: expected the manifest of a run, with its \"host\"; without this "
          "file a merge loses the machine of the run");
    }
    const Json hosts = is_list ? host->at("merged") : Json::array({*host});
    for (const Json& one : hosts) merged.push_back(one);
  }
  return json_bytes(merged);
}

std::string merged_manifest(const std::string& manifest, const std::string& hosts) {
  Json json = parse_bounded<Json>(manifest);
  json["host"] = {{"merged", Json::parse(hosts)}};
  return json_bytes(json);
}

Provenance provenance_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                         const std::vector<InputFile>& inputs) {
  Provenance provenance = {{"dataset", experiment.dataset.resolved()},
                           {"inputs", deciding_inputs_json(groups, inputs)},
                           {"seed", std::to_string(experiment.seed)},
                           {"starts", deciding_starts_json(experiment.starts)},
                           {"success", success_json(experiment.success)}};
  // Keeps stores compatible that were written before groups existed.
  if (experiment.scenes_per_trial > 1) {
    provenance["scenes_per_trial"] = std::to_string(experiment.scenes_per_trial);
  }
  return provenance;
}

StoreHeader header_of(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                      const Provenance& provenance, const std::string& manifest) {
  StoreHeader header;
  header.provenance = provenance;
  header.versions = versions_of(experiment);
  header.builds = {this_build()};
  header.manifest = manifest;
  header.trials = total_trials(experiment.starts);
  for (const Variant& variant : experiment.variants) {
    header.variants.push_back({variant.name, pipeline_json(variant.pipeline).dump()});
  }
  for (const SceneGroup& group : groups) header.scenes.push_back({group.name, group.kind});
  std::map<std::string, std::string> targets;
  for (const SceneGroup& group : groups) {
    for (const SensorPair& pair : group.pairs) targets.emplace(pair.name, pair.target);
  }
  for (const std::string& sensor : sensor_names(groups)) {
    header.sensors.push_back({sensor, targets.at(sensor)});
  }
  return header;
}

}  // namespace croon::experiments
