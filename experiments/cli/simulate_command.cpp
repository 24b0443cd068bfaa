#include "experiments/cli/simulate_command.hpp"

#include <tbb/info.h>

#include <nlohmann/json.hpp>

#include "experiments/cli/scene_writer.hpp"
#include "experiments/cli/starts_command.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/report/progress.hpp"
#include "experiments/run/run_request.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/starts.hpp"
#include "framework/base/threads.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/stage/rig_files.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// What the dataset in a folder was made from; another program may not go on with it.
constexpr const char* kRecipe = "simulation.json";

/// The starts of an experiment that reads them, beside the scenes.
constexpr const char* kStarts = "starts.csv";

std::vector<Scene> scenes_to_write(Experiment& experiment) {
  std::vector<Scene> scenes = scenes_of(experiment, fs::path());
  for (const Scene& scene : scenes) {
    if (scene.reference.measure) continue;
    throw InputError(experiment.file, "/dataset/type",
                     "expected a dataset that is simulated, found \"" + experiment.dataset.name() +
                         "\", whose clouds are files already");
  }
  resolve_starts(experiment, scenes, data_root({}));
  return scenes;
}

/// What decides the bytes of the dataset.
std::string recipe_json(const Experiment& experiment) {
  nlohmann::ordered_json json = {
      {"dataset", nlohmann::ordered_json::parse(experiment.dataset.resolved())},
      {"starts", nlohmann::ordered_json::parse(deciding_starts_json(experiment.starts))},
      {"seed", experiment.seed}};
  return json.dump(2) + "\n";
}

/// Makes the folder ready; refuses one with something else in it.
void prepare(const fs::path& folder, const std::string& recipe) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw InputError(folder.string(), "", "expected a folder to write to: " + error.message());
  }
  if (fs::is_empty(folder)) return write_whole_file(folder / kRecipe, recipe);
  if (fs::exists(folder / kRecipe) && read_whole_file(folder / kRecipe) == recipe) return;
  throw InputError(folder.string(), "",
                   "expected a new folder, or one with the same scenes; found something else");
}

/// The experiment with its dataset, and its file of starts, replaced by the written ones.
std::string experiment_on(const Experiment& experiment) {
  auto json = nlohmann::ordered_json::parse(experiment.merged);
  json["dataset"] = {{"type", "opencalib"}, {"path", "."}};
  if (json.contains("starts") && json["starts"].contains("file")) json["starts"]["file"] = kStarts;
  return json.dump(2) + "\n";
}

/// The pose of each sensor; a rig is the same in all scenes.
std::string truth_json(const Scene& scene) {
  RigPoses poses;
  for (const SensorScan& scan : scene.sensors) {
    if (scan.truth) poses[scan.sensor] = *scan.truth;
  }
  return rig_poses_json(poses);
}

std::string kinds_json(const std::vector<Scene>& scenes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Scene& scene : scenes) {
    if (!scene.kind.empty()) json[scene.name] = scene.kind;
  }
  return json.dump(2) + "\n";
}

void write_scenes(const SimulateOptions& options, const Experiment& experiment,
                  const std::vector<Scene>& scenes, Progress& progress) {
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  on_threads(jobs, [&] {
    for_each_in_parallel(scenes.size(), [&](std::size_t i) {
      const Scene& scene = scenes[i];
      if (!is_written(scene, options.out)) write_scene(experiment, scene, options.out);
      if (options.png) draw_scene(scene, options.out);
      progress.advance();
    });
  });
}

}  // namespace

int simulate_command(const SimulateOptions& options, const Catalogue& catalogue, std::ostream& out,
                     std::ostream& progress_out) {
  Experiment experiment = load_experiment(options.experiment, catalogue);
  const std::vector<Scene> started = scenes_to_write(experiment);
  const std::vector<Scene> scenes = without_pairs(started);
  prepare(options.out, recipe_json(experiment));
  {
    Progress progress(progress_out, progress_style_of_stderr(options.quiet), scenes.size());
    write_scenes(options, experiment, scenes, progress);
    progress.finish();
  }
  write_whole_file(options.out / "truth.json", truth_json(scenes.front()));
  write_whole_file(options.out / "scene_kinds.json", kinds_json(scenes));
  if (experiment.starts.table) {
    write_whole_file(options.out / kStarts, starts_csv(experiment, started));
  }
  write_whole_file(options.out / "experiment.json", experiment_on(experiment));
  const std::string folder = options.out.string();
  out << scenes.size() << (scenes.size() == 1 ? " scene is in " : " scenes are in ") << folder
      << "; run them with: croon run " << (options.out / "experiment.json").string() << " --data "
      << folder << "\n";
  return 0;
}

}  // namespace croon::experiments
