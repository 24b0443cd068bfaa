#include "experiments/cli/commands.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/run/given_csv.hpp"
#include "experiments/run/scene_groups.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/session/output_files.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/picture/cloud_view.hpp"
#include "framework/stage/rig_files.hpp"
#include "framework/stage/velocity_numbers.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with;  ///< Workloads, see load_experiment.
  std::filesystem::path out;                ///< The folder of the dataset.
  int jobs = 0;                             ///< 0: all cores.
  bool png = false;                         ///< Draw each scene.
  bool quiet = false;                       ///< No progress.
};

/// The recipe of the dataset in a folder; only a run with the same recipe may continue it.
constexpr const char* kRecipe = "simulation.json";

constexpr const char* kTruth = "truth.json";
constexpr const char* kKinds = "scene_kinds.json";
constexpr const char* kExperiment = "experiment.json";

/// The initial guesses, if the experiment reads them from a file.
constexpr const char* kStarts = "starts.csv";

/// The velocity of each scene, for the step known_velocity.
constexpr const char* kVelocities = "velocities.csv";

constexpr const char* kCloudList = "lidar_cloud_path.txt";

/// The path of a cloud in its list, relative to the dataset.
std::string cloud_path(const Scene& scene, const SensorScan& scan) {
  return scene.name + "/" + scan.sensor + ".pcd";
}

/// The velocity of each sensor of `scene` in its own frame, if the dataset provides it.
std::string velocities_json(const Scene& scene) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  const auto add = [&](const SensorScan& scan) {
    if (!scan.velocity) return;
    const Twist velocity = scan.velocity();
    const Eigen::Vector3d angular_degps = velocity.angular_radps.unaryExpr(&deg_from_rad);
    const auto list = [](const Eigen::Vector3d& v) { return std::vector{v.x(), v.y(), v.z()}; };
    json[scan.sensor] = {{"linear_mps", list(velocity.linear_mps)},
                         {"angular_degps", list(angular_degps)}};
  };
  add(scene.reference);
  for (const SensorScan& scan : scene.sensors) add(scan);
  return json.dump(2) + "\n";
}

/// A row of the file of velocities; see velocity_header.
struct VelocityRow {
  std::string scene;
  Twist velocity;  ///< Of the reference, in its own frame.
};

std::string velocities_csv(const std::vector<VelocityRow>& rows) {
  Columns<VelocityRow> columns;
  columns.add({"scene"}, &VelocityRow::scene);
  for (const VelocityNumber& number : velocity_numbers()) {
    columns.add({number.name, number.unit},
                [number](const VelocityRow& row) { return number.of(row.velocity); });
  }
  return csv_of(columns, rows);
}

/// By scene: the name under which its starts are looked up, i.e. the name of its group, or its own
/// name if it is in no group.
using TrialScenes = std::map<std::string, std::string>;

TrialScenes trial_scenes(const std::vector<Scene>& scenes, const std::vector<SceneGroup>& started) {
  TrialScenes names;
  for (const Scene& scene : scenes) names[scene.name] = scene.name;
  for (const SceneGroup& group : started) {
    for (const Scene& scene : group.scenes) names[scene.name] = group.name;
  }
  return names;
}

/// The start of trial 0. A scene outside all groups has no entry in a file of starts; its start is
/// the ground truth.
RigidTransform first_start(const Experiment& experiment, const std::string& trial_scene,
                           const CalibratedPair& pair) {
  const auto& table = experiment.starts.table;
  if (table && table->starts.count({trial_scene, pair.name}) == 0) return *pair.truth;
  return start_of(experiment, trial_scene, pair, 0);
}

/// Writes the folder of `scene` below `dataset`: a PCD per sensor, `initial_extrinsic.txt` with the
/// starts of trial 0, `velocities.json`, and last `lidar_cloud_path.txt`, which marks the scene as
/// complete.
void write_scene(const Experiment& experiment, const Scene& scene, const std::string& trial_scene,
                 const fs::path& dataset) {
  const fs::path folder = dataset / scene.name;
  make_folder_below(dataset, scene.name);
  write_pcd(dataset / cloud_path(scene, scene.reference), scene.reference.load());
  std::vector<ListedCloud> clouds = {
      {0, cloud_path(scene, scene.reference), "", scene.reference.sensor}};
  std::vector<ListedPose> starts = {{0, {}, ""}};
  for (const SensorScan& scan : scene.sensors) {
    const int device_id = static_cast<int>(clouds.size());
    write_pcd(dataset / cloud_path(scene, scan), scan.load());
    clouds.push_back({device_id, cloud_path(scene, scan), "", scan.sensor});
    starts.push_back(
        {device_id, first_start(experiment, trial_scene, to_reference(scene, scan)), ""});
  }
  write_whole_file(folder / "initial_extrinsic.txt", pose_list_text(starts));
  write_whole_file(folder / "velocities.json", velocities_json(scene));
  write_whole_file(folder / kCloudList, cloud_list_text(clouds));
}

/// Whether `path` is a regular file, not a link, with a complete cloud.
bool is_whole_cloud(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return false;
  try {
    parse_pcd(read_whole_file(path), path.string());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Whether the scene is complete.
bool is_written(const Scene& scene, const fs::path& dataset) {
  if (!fs::is_regular_file(fs::symlink_status(dataset / scene.name / kCloudList))) return false;
  return is_whole_cloud(dataset / cloud_path(scene, scene.reference)) &&
         std::all_of(scene.sensors.begin(), scene.sensors.end(), [&](const SensorScan& scan) {
           return is_whole_cloud(dataset / cloud_path(scene, scan));
         });
}

/// Draws `scene` beside its folder: a view from behind the car if the dataset has one, and the
/// clouds from above at their ground-truth poses.
void draw_scene(const Scene& scene, const fs::path& dataset) {
  std::vector<ColouredCloud> clouds = {{scene.reference.sensor, scene.reference.load().points, {}}};
  for (const SensorScan& scan : scene.sensors) {
    clouds.push_back({scan.sensor, scan.load().points, scan.truth.value_or(RigidTransform{})});
  }
  std::vector<Image> images;
  if (scene.draw) images.push_back(scene.draw());
  images.push_back(draw_view(clouds, {25.0, 15.0, 0.06}));
  constexpr int kGap_px = 8;
  write_png(dataset / (scene.name + ".png"), side_by_side(images, kGap_px));
}

std::vector<SceneGroup> groups_to_write(Experiment& experiment) {
  const fs::path data = data_root({});
  std::vector<SceneGroup> groups = scene_groups(experiment, data);
  for (const SceneGroup& group : groups) {
    if (group.scenes.front().reference.file.empty()) continue;
    throw InputError(experiment.file, "/dataset/type",
                     "expected a simulated dataset, found \"" + experiment.dataset.name() +
                         "\", whose clouds are already files");
  }
  resolve_starts(experiment, groups, data);
  return groups;
}

/// The settings that determine the bytes of the dataset.
std::string recipe_json(const Experiment& experiment) {
  StartRule starts = experiment.starts;
  starts.trials = 0;
  nlohmann::ordered_json json = {
      {"dataset", nlohmann::ordered_json::parse(experiment.dataset.resolved())},
      {"starts", nlohmann::ordered_json::parse(starts_json(starts))},
      {"seed", experiment.seed}};
  if (experiment.scenes_per_trial > 1) json["scenes_per_trial"] = experiment.scenes_per_trial;
  return json.dump(2) + "\n";
}

/// Whether the folder is empty except for an incomplete recipe of a killed process.
bool is_unused(const fs::path& folder) {
  const fs::directory_iterator entries(folder);
  return std::all_of(fs::begin(entries), fs::end(entries), [&](const fs::directory_entry& entry) {
    return is_part_of(entry.path(), folder / kRecipe);
  });
}

/// Creates the folder with the recipe, or accepts one with the same recipe; else throws InputError.
void prepare(const fs::path& folder, const std::string& recipe) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw InputError(folder.string(), "", "expected a folder to write to: " + error.message());
  }
  if (is_unused(folder)) return write_whole_file(folder / kRecipe, recipe);
  if (fs::exists(folder / kRecipe) && read_whole_file(folder / kRecipe) == recipe) return;
  throw InputError(folder.string(), "",
                   "expected an empty folder, or one with the same scenes; found other content");
}

/// Copies, in `folder`, of the files that the variants name.
std::vector<OutputFile> copies_of_given_files(const Experiment& experiment,
                                              const fs::path& folder) {
  const fs::path beside = fs::path(experiment.file).parent_path();
  const std::set<std::string> written = {kTruth,      kKinds,  kExperiment,
                                         kVelocities, kStarts, kRecipe};
  std::vector<OutputFile> copies;
  for (const std::string& name : given_files(experiment)) {
    if (fs::path(name).is_absolute() || fs::path(name).lexically_normal() != name) {
      throw InputError(experiment.file, "",
                       "expected a file to copy below the experiment's folder, by a path without "
                       "\".\" and \"..\", found " +
                           in_quotes(name));
    }
    // Otherwise the variant reads the velocities of the dataset.
    const bool is_there = fs::exists(data_root({}) / name) || fs::exists(beside / name);
    if (name == kVelocities && !is_there) continue;
    if (written.count(name) > 0) {
      throw InputError(experiment.file, "",
                       "expected a file name that croon simulate does not write itself, found " +
                           in_quotes(name));
    }
    const Fault at = {experiment.file, "", ""};
    copies.push_back({folder / name, read_whole_file(found_input(experiment, name, data_root({}),
                                                                 at, "a file that it names"))});
  }
  return copies;
}

/// The experiment with its dataset, and its file of starts, replaced by the written ones.
std::string experiment_on(const Experiment& experiment) {
  nlohmann::ordered_json json = *experiment.merged;
  json["dataset"] = {{"type", "opencalib"}, {"path", "."}};
  if (json.contains("starts") && json["starts"].contains("file")) {
    json["starts"]["file"] = kStarts;
    json["starts"].erase("sha256");
  }
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

/// Writes the incomplete scenes. Returns the velocities of all scenes that have them.
std::vector<VelocityRow> write_scenes(const SimulateOptions& options, const Experiment& experiment,
                                      const std::vector<Scene>& scenes, const TrialScenes& names,
                                      Progress& progress) {
  std::vector<VelocityRow> velocities(scenes.size());
  const int jobs = options.jobs > 0 ? options.jobs : tbb::info::default_concurrency();
  on_threads(jobs, [&] {
    for_each_in_parallel(scenes.size(), [&](std::size_t i) {
      const Scene& scene = scenes[i];
      if (!is_written(scene, options.out)) {
        write_scene(experiment, scene, names.at(scene.name), options.out);
      }
      if (options.png) draw_scene(scene, options.out);
      if (scene.reference.velocity) velocities[i] = {scene.name, scene.reference.velocity()};
      progress.advance();
    });
  });
  velocities.erase(std::remove_if(velocities.begin(), velocities.end(),
                                  [](const VelocityRow& row) { return row.scene.empty(); }),
                   velocities.end());
  return velocities;
}

/// Writes the simulated scenes of an experiment in the layout of the paper's authors: binary PCD
/// clouds, lists, `truth.json`, `scene_kinds.json`, and `experiment.json`, which reproduces the
/// results of the experiment on them. Complete scenes are kept; a folder with other content is
/// refused.
int simulate_command(const SimulateOptions& options, const Catalogue& catalogue, std::ostream& out,
                     std::ostream& progress_out) {
  Experiment experiment = load_experiment(options.experiment, catalogue, options.with);
  const std::vector<SceneGroup> started = groups_to_write(experiment);
  // Also scenes outside all groups: without them, the groups of the written dataset would differ.
  const std::vector<Scene> scenes = dataset_scenes(experiment, fs::path());
  const std::vector<OutputFile> copies = copies_of_given_files(experiment, options.out);
  prepare(options.out, recipe_json(experiment));
  std::vector<VelocityRow> velocities;
  {
    Progress progress(progress_out, progress_style_of_stderr(options.quiet), scenes.size());
    velocities = write_scenes(options, experiment, scenes, trial_scenes(scenes, started), progress);
    progress.finish();
  }
  std::vector<OutputFile> files = {{options.out / kTruth, truth_json(scenes.front())},
                                   {options.out / kKinds, kinds_json(scenes)},
                                   {options.out / kExperiment, experiment_on(experiment)}};
  if (!velocities.empty()) {
    files.push_back({options.out / kVelocities, velocities_csv(velocities)});
  }
  if (experiment.starts.table) {
    files.push_back({options.out / kStarts, starts_csv(experiment, started)});
  }
  for (const OutputFile& copy : copies) {
    fs::create_directories(copy.path.parent_path());
    files.push_back(copy);
  }
  write_output_files(files);
  const std::string folder = printable(options.out.string());
  out << scenes.size() << (scenes.size() == 1 ? " scene is in " : " scenes are in ") << folder
      << "; run them with: croon run " << printable((options.out / kExperiment).string())
      << " --data " << folder << "\n";
  return 0;
}

class SimulateCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Write the simulated scenes of an experiment as a dataset.";
  }

  void add_options(CLI::App& command) override {
    add_experiment(command, options_.experiment, options_.with);
    add_path(command, "--out", options_.out, "Folder to write the dataset to.")->required();
    add_jobs(command, options_.jobs);
    command.add_flag("--png", options_.png, "Draw each scene, from behind the car and from above.");
    command.add_flag("--quiet", options_.quiet, "Do not show progress.");
  }

  int run(const Console& console) override {
    return simulate_command(options_, console.catalogue, console.out, console.err);
  }

 private:
  SimulateOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace croon::experiments
