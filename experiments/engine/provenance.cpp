#include "experiments/engine/provenance.hpp"

#include <algorithm>

#include "experiments/engine/experiment_loader.hpp"
#include "experiments/engine/threads.hpp"
#include "framework/io/digest.hpp"
#include "framework/params/values.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;
using params::value_json;

void add_file(std::vector<std::string>& files, const std::string& file) {
  if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) {
    files.push_back(file);
  }
}

/// `file` relative to the data root; as it is where it lies elsewhere.
std::string relative_path(const std::string& file, const fs::path& data_root) {
  std::error_code error;
  const fs::path relative = fs::relative(file, data_root, error);
  const bool is_below = !error && !relative.empty() && *relative.begin() != "..";
  return is_below ? relative.generic_string() : file;
}

/// The numbers of a pose, each exact; "none" where there is no pose.
std::string pose_text(const std::optional<RigidTransform>& T) {
  if (!T) return "none";
  std::string text;
  for (int i = 0; i < 9; ++i) text += value_json(T->rotation(i / 3, i % 3)) + " ";
  for (int i = 0; i < 3; ++i) text += value_json(T->translation(i)) + " ";
  return text;
}

std::string inputs_text(const std::vector<Scene>& scenes, const std::vector<InputFile>& inputs) {
  std::string text;
  for (const InputFile& input : inputs) text += input.sha256 + " " + input.path + "\n";
  for (const Scene& scene : scenes) {
    text += scene.name + "\n" + scene.reference.sensor + "\n";
    for (const SensorScan& scan : scene.sensors) {
      text += scan.sensor + "\n" + pose_text(scan.truth) + "\n" + pose_text(scan.nominal) + "\n" +
              pose_text(scan.initial) + "\n";
    }
  }
  return text;
}

std::string pipelines_text(const Experiment& experiment) {
  std::string text;
  for (const Variant& variant : experiment.variants) {
    text += variant.name + "\n" + variant.resolved + "\n";
  }
  return text;
}

}  // namespace

std::vector<InputFile> input_files(const std::vector<Scene>& scenes, const fs::path& data_root,
                                   int jobs) {
  std::vector<std::string> files;
  for (const Scene& scene : scenes) {
    add_file(files, scene.reference.file);
    for (const SensorScan& scan : scene.sensors) add_file(files, scan.file);
  }
  std::vector<InputFile> inputs(files.size());
  on_threads(jobs, [&] {
    for_each_in_parallel(files.size(), [&](std::size_t i) {
      inputs[i] = {relative_path(files[i], data_root), sha256_of_file(files[i])};
    });
  });
  return inputs;
}

std::string start_rule_json(const StartRule& rule) {
  return "{\"around\":\"" + std::string(centre_name(rule.around)) +
         "\",\"rotation_deg\":" + value_json(rule.rotation_deg) +
         ",\"translation_m\":" + value_json(rule.translation_m) + "}";
}

std::string success_json(const SuccessBounds& bounds) {
  return "{\"rotation_deg\":" + value_json(bounds.rotation_deg) +
         ",\"translation_m\":" + value_json(bounds.translation_m) + "}";
}

Provenance provenance_of(const Experiment& experiment, const std::vector<Scene>& scenes,
                         const std::vector<InputFile>& inputs) {
  return {{"dataset", experiment.dataset.resolved()},
          {"inputs", sha256_of_text(inputs_text(scenes, inputs))},
          {"pipelines", sha256_of_text(pipelines_text(experiment))},
          {"program", sha256_of_file("/proc/self/exe")},
          {"seed", std::to_string(experiment.seed)},
          {"starts", start_rule_json(experiment.starts)},
          {"success", success_json(experiment.success)}};
}

}  // namespace croon::experiments
