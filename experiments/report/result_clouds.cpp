#include "experiments/report/result_clouds.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/starts.hpp"
#include "framework/base/error.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/vdb_writer.hpp"
#include "framework/picture/top_view.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// The first trial with an estimate of each variant, scene and sensor.
using FirstTrials = std::map<std::tuple<std::string, std::string, std::string>, const TrialRecord*>;

FirstTrials first_trials(const std::vector<TrialRecord>& records) {
  FirstTrials trials;
  for (const TrialRecord& record : records) {
    if (!record.T_reference_sensor) continue;
    // emplace keeps the first, and records are sorted by trial.
    trials.emplace(std::tuple(record.id.variant, record.id.scene, record.id.sensor), &record);
  }
  return trials;
}

/// The trial of each sensor of `scene`; null for a sensor that has none.
std::vector<const TrialRecord*> trials_in(const FirstTrials& trials, const Variant& variant,
                                          const Scene& scene) {
  std::vector<const TrialRecord*> of_scene;
  for (const SensorScan& scan : scene.sensors) {
    const auto found = trials.find(std::tuple(variant.name, scene.name, scan.sensor));
    of_scene.push_back(found == trials.end() ? nullptr : found->second);
  }
  return of_scene;
}

/// The picture of a scene whose sensors ended at `trials`.
Image drawn(const Experiment& experiment, const Scene& scene,
            const std::vector<const TrialRecord*>& trials) {
  std::vector<ColouredCloud> before = {{scene.reference.sensor, scene.reference.load().points, {}}};
  std::vector<ColouredCloud> after = before;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const SensorScan& scan = scene.sensors[i];
    const PointCloud points = scan.load().points;
    const int trial = trials[i]->id.trial;
    before.push_back({scan.sensor, points, start_of(experiment, scene.name, scan, trial)});
    after.push_back({scan.sensor, points, *trials[i]->T_reference_sensor});
  }
  constexpr TopView kView = {20.0, 20.0, 0.05};
  std::vector<std::string> sensors;
  for (const ColouredCloud& cloud : after) sensors.push_back(cloud.sensor);
  return with_legend({top_view(before, kView), top_view(after, kView)},
                     {"before: the starts", "after: the results"}, sensors, kView.pixel_m);
}

/// The points of `scan`; none if it cannot be read, which is the reason of its failed trials.
PointCloud points_of(const SensorScan& scan) {
  try {
    return scan.load().points;
  } catch (const InputError&) {
    return {};
  }
}

void write_clouds(const std::vector<ColouredCloud>& clouds, const fs::path& stem) {
  constexpr double kLeafSize_m = 0.05;
  std::error_code error;
  fs::create_directories(stem.parent_path(), error);
  if (error) throw InputError(stem.parent_path().string(), "", error.message());
  write_fused_ply(stem.string() + ".ply", clouds);
  PointCloud fused;
  for (const ColouredCloud& cloud : clouds) {
    const PointCloud moved_points = transformed(cloud.points, cloud.T_reference_sensor);
    fused.insert(fused.end(), moved_points.begin(), moved_points.end());
  }
  write_occupancy_vdb(stem.string() + ".vdb", fused, kLeafSize_m);
}

}  // namespace

std::string draw_before_after(const Experiment& experiment, const std::vector<Scene>& scenes,
                              const std::vector<TrialRecord>& records, const fs::path& path) {
  const FirstTrials first = first_trials(records);
  for (const Scene& scene : without_pairs(scenes)) {
    const auto trials = trials_in(first, experiment.variants.front(), scene);
    if (std::count(trials.begin(), trials.end(), nullptr) > 0) continue;
    write_png(path, drawn(experiment, scene, trials));
    return scene.name;
  }
  return "";
}

std::vector<std::string> write_fused_clouds(const Experiment& experiment,
                                            const std::vector<Scene>& scenes,
                                            const std::vector<TrialRecord>& records,
                                            const fs::path& folder) {
  const FirstTrials first = first_trials(records);
  std::vector<std::string> complaints;
  for (const Scene& scene : without_pairs(scenes)) {
    const PointCloud reference = points_of(scene.reference);
    std::vector<PointCloud> points;
    for (const SensorScan& scan : scene.sensors) points.push_back(points_of(scan));
    for (const Variant& variant : experiment.variants) {
      const auto trials = trials_in(first, variant, scene);
      std::vector<ColouredCloud> clouds = {{scene.reference.sensor, reference, {}}};
      for (std::size_t i = 0; i < trials.size(); ++i) {
        if (trials[i] == nullptr) continue;
        clouds.push_back({scene.sensors[i].sensor, points[i], *trials[i]->T_reference_sensor});
      }
      if (clouds.size() == 1) continue;
      const fs::path stem = folder / variant.name / scene.name;
      try {
        write_clouds(clouds, stem);
      } catch (const StageError& error) {
        // A pose may be farther off than leaves can be.
        complaints.push_back(stem.string() + ".vdb: not written: " + error.what());
      }
    }
  }
  return complaints;
}

}  // namespace croon::experiments
