#include <cstdio>
#include <deque>
#include <mutex>

#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/rig_files.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::dataset {
namespace {

using simulation::Recipe;
using simulation::SimulatedScene;

struct Params : Recipe {
  int scenes = 100;
  int first_scene = 0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::integer("scenes", &Params::scenes, {1, 100000},
                        "Number of scenes; for more, run several experiments with different values "
                        "of first_scene."),
        params::integer("first_scene", &Params::first_scene, {0, 1000000},
                        "Number of the first scene. Each scene is independent of the others."),
    };
    rows.inherit(simulation::recipe_table());
    return rows;
  }();
  return table;
}

/// Builds scenes on demand and keeps the last few, so that the sensors of one scene share it.
/// Thread-safe.
class SceneCache {
 public:
  explicit SceneCache(const Recipe& recipe) : recipe_(std::make_shared<const Recipe>(recipe)) {}

  std::shared_ptr<const SimulatedScene> scene(std::uint64_t index) {
    const std::shared_ptr<Entry> entry = entry_of(index);
    std::call_once(entry->once,
                   [&] { entry->scene = std::make_shared<const SimulatedScene>(recipe_, index); });
    return entry->scene;
  }

 private:
  struct Entry {
    std::uint64_t index = 0;
    std::once_flag once;
    std::shared_ptr<const SimulatedScene> scene;
  };

  std::shared_ptr<Entry> entry_of(std::uint64_t index) {
    constexpr std::size_t kKept = 4;
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::shared_ptr<Entry>& entry : entries_) {
      if (entry->index == index) return entry;
    }
    entries_.push_back(std::make_shared<Entry>());
    entries_.back()->index = index;
    if (entries_.size() > kKept) entries_.pop_front();
    return entries_.back();
  }

  std::shared_ptr<const Recipe> recipe_;
  std::mutex mutex_;
  std::deque<std::shared_ptr<Entry>> entries_;
};

/// "000042".
std::string scene_name(int index) {
  char text[16];
  std::snprintf(text, sizeof text, "%06d", index);
  return text;
}

class Simulated final : public Dataset {
 public:
  explicit Simulated(Params params) : params_(std::move(params)) {}

  std::vector<Scene> scenes(const std::filesystem::path&) const override {
    check_size();
    const auto cache = std::make_shared<SceneCache>(params_);
    std::vector<Scene> scenes;
    for (int i = 0; i < params_.scenes; ++i) {
      scenes.push_back(scene(params_.first_scene + i, cache));
    }
    return scenes;
  }

 private:
  /// Throws InputError if the clouds of one scene, or the list of scenes, do not fit into memory.
  void check_size() const {
    // Per ray: its direction, its hit, the measurement, and a kd-tree leaf.
    constexpr double kRayBytes = 150.0;
    constexpr double kScanBytes = sizeof(SensorScan) + 200.0;
    double rays = 0.0;
    for (const auto& [name, mounting] : params_.rig.sensors) {
      rays += simulation::ray_count(mounting.model);
    }
    require_memory(rays * kRayBytes, "a scene of " + fixed_number(rays, 0) + " rays",
                   "reduce the rings of the rig's sensors or increase azimuth_step_deg",
                   {"", "/rig", ""});
    require_memory(kScanBytes * params_.scenes * static_cast<double>(params_.rig.sensors.size()),
                   "a list of " + std::to_string(params_.scenes) + " scenes", "reduce it",
                   {"", "/scenes", ""});
  }

  Scene scene(int number, const std::shared_ptr<SceneCache>& cache) const {
    const auto index = static_cast<std::uint64_t>(number);
    Scene scene;
    scene.name = scene_name(number);
    scene.kind = simulation::row_of(simulation::scene_kind(params_, index)).name;
    for (const auto& [name, mounting] : params_.rig.sensors) {
      SensorScan scan;
      scan.sensor = name;
      scan.load = [cache, index, sensor = name] {
        return LoadedCloud{cache->scene(index)->scan_of(sensor)};
      };
      scan.channels = {kIntensity, kRing, kTime};
      if (mounting.model.rosette_rays > 0) scan.channels = {kIntensity, kTime};
      scan.velocity = [cache, index, sensor = name] {
        return cache->scene(index)->velocity_of(sensor);
      };
      if (name == params_.rig.reference) {
        scene.reference = scan;
      } else {
        // Rounded as in a file, so that a scene read from files yields bitwise the same results.
        scan.truth = pose_as_written(mounting.T_reference_sensor());
        scene.sensors.push_back(scan);
      }
    }
    scene.draw = [cache, index] { return cache->scene(index)->picture(); };
    return scene;
  }

  Params params_;
};

}  // namespace

StageEntry simulated() {
  return stage_entry<Simulated>("simulated",
                                "Road scenes with exact ground truth, built and ray-cast on "
                                "demand; nothing is downloaded or written.",
                                "croon, after the paper's simulated experiment", table(), 2);
}

}  // namespace croon::stages::dataset
