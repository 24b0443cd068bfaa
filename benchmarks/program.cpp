// What do the time and memory of `croon calibrate` amount to, from the start of the process to the
// extrinsics of five sensors, with two threads?

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "benchmarks/support/run.hpp"
#include "framework/base/angles.hpp"
#include "framework/calibration/extrinsics.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/support/temp_folder.hpp"

extern char** environ;  // NOLINT: POSIX declares it nowhere.

namespace croon::benchmarks {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSensors = {"top", "front", "back", "left", "right"};

/// The rig of the CARLA samples with sensors of about 130 000 points each.
const char* const kLargeScene = R"({
  "name": "large", "starts": {"trials": 1}, "pipeline": [{"step": "ground_alignment"}],
  "dataset": {"type": "simulated", "scenes": 1, "seed": 5, "mix": {"suburban": 1},
    "noise": "real_still", "rig": {"reference": "top", "reference_height_m": 2.1,
    "reference_forward_m": -0.525, "sensors": {
    "top": {"model": {"like": "carla_pandar64", "azimuth_step_deg": 0.163}},
    "front": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 0.095},
              "rotation_rpy_deg": [0, 48, 0], "translation_m": [2.9, 0.15, -1.195]},
    "back": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 0.095},
             "rotation_rpy_deg": [0, 48, 180], "translation_m": [-1.8, 0, -0.82]},
    "left": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 0.095},
             "rotation_rpy_deg": [0, 48, -90], "translation_m": [0.25, -0.85, -0.595]},
    "right": {"model": {"like": "carla_pandar_qt", "azimuth_step_deg": 0.095},
              "rotation_rpy_deg": [0, 48, 90], "translation_m": [0.25, 0.85, -0.595]}}}}})";

/// Runs the program to its end without output and returns its peak resident memory in bytes. Throws
/// if it fails. The peak is at least that of this process, which holds one cloud at most.
double peak_bytes_of(std::vector<std::string> words) {
  words.insert(words.begin(), CROON_PROGRAM);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure =
      ::posix_spawn(&child, CROON_PROGRAM, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " + words[0]);
  int status = 0;
  struct rusage usage = {};
  if (::wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error(words[0] + " " + words[1] + " failed");
  }
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Sets the counters of the largest errors of a rig. Throws if a sensor is missing.
void set_errors(benchmark::State& state, const fs::path& found_file, const fs::path& truth_file) {
  const Extrinsics found = read_extrinsics(found_file);
  double rotation_deg = 0.0;
  double translation_m = 0.0;
  for (const ExtrinsicPose& truth : read_extrinsics(truth_file).poses) {
    const auto pose =
        std::find_if(found.poses.begin(), found.poses.end(),
                     [&](const ExtrinsicPose& one) { return one.sensor == truth.sensor; });
    if (pose == found.poses.end()) throw std::runtime_error("no pose of " + truth.sensor);
    const PoseError error = pose_error(pose->T_parent_sensor, truth.T_parent_sensor);
    rotation_deg = std::max(rotation_deg, deg_from_rad(error.rotation_rad));
    translation_m = std::max(translation_m, error.translation_m);
  }
  state.counters["max_rotation_deg"] = rotation_deg;
  state.counters["max_translation_m"] = translation_m;
}

/// `folder` has a cloud for each sensor; `truth` their poses.
void measure(benchmark::State& state, const fs::path& folder, const fs::path& truth,
             const std::vector<std::string>& options) {
  const test::TempFolder out;
  std::vector<std::string> words = {"calibrate", "--quiet", "--jobs", "2", "--out", out.path()};
  words.insert(words.end(), options.begin(), options.end());
  for (const std::string& sensor : kSensors) words.push_back(folder / (sensor + ".pcd"));
  double peak_bytes = 0.0;
  for (auto _ : state) peak_bytes = std::max(peak_bytes, peak_bytes_of(words));
  set_errors(state, out.path() / "extrinsics.json", truth);
  double points = 0.0;
  for (const std::string& sensor : kSensors) {
    points += static_cast<double>(read_point_cloud(folder / (sensor + ".pcd")).points.size());
  }
  state.counters["peak_bytes"] = peak_bytes;
  state.counters["points"] = points;
}

void add_calibrations(const std::string& name, const fs::path& folder, const fs::path& truth) {
  add("program/" + name + "/extrinsics", benchmark::kMillisecond,
      [=](benchmark::State& state) { measure(state, folder, truth, {"--no-pictures"}); });
  add("program/" + name + "/with_report", benchmark::kMillisecond,
      [=](benchmark::State& state) { measure(state, folder, truth, {}); });
}

void check_and_add() {
  static const test::TempFolder simulated;
  const fs::path large = simulated.path() / "large";
  peak_bytes_of(
      {"simulate", simulated.write("large.json", kLargeScene), "--out", large, "--quiet"});
  add_calibrations("five_of_130000_points", large / "000000", large / "truth.json");
  if (const char* data_root = std::getenv("CROON_DATA")) {
    const fs::path carla = fs::path(data_root) / "opencalib" / "carla";
    add_calibrations("carla/004069", carla / "004069", carla / "truth.json");
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
