#include "experiments/report/before_after.hpp"

#include <algorithm>
#include <map>

#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/starts.hpp"
#include "framework/picture/top_view.hpp"

namespace croon::experiments {
namespace {

/// The first trials of one variant in one scene, by sensor.
using FirstTrials = std::map<std::string, const TrialRecord*>;

FirstTrials first_trials(const std::vector<TrialRecord>& records, const std::string& variant,
                         const Scene& scene) {
  FirstTrials trials;
  for (const TrialRecord& record : records) {
    if (record.id.variant != variant || record.id.scene != scene.name) continue;
    // emplace keeps the first, and records are sorted by trial.
    if (record.T_reference_sensor) trials.emplace(record.id.sensor, &record);
  }
  return trials;
}

Image drawn(const Experiment& experiment, const Scene& scene, const FirstTrials& trials) {
  std::vector<ColouredCloud> before = {{scene.reference.sensor, scene.reference.load().points, {}}};
  std::vector<ColouredCloud> after = before;
  for (const SensorScan& scan : scene.sensors) {
    const TrialRecord& trial = *trials.at(scan.sensor);
    const PointCloud points = scan.load().points;
    before.push_back({scan.sensor, points, start_of(experiment, scene.name, scan, trial.id.trial)});
    after.push_back({scan.sensor, points, *trial.T_reference_sensor});
  }
  constexpr TopView kView = {20.0, 20.0, 0.05};
  constexpr int kGap_px = 8;
  return side_by_side({top_view(before, kView), top_view(after, kView)}, kGap_px);
}

}  // namespace

std::string draw_before_after(const Experiment& experiment, const std::vector<Scene>& scenes,
                              const std::vector<TrialRecord>& records,
                              const std::filesystem::path& path) {
  for (const Scene& scene : without_pairs(scenes)) {
    const FirstTrials trials = first_trials(records, experiment.variants.front().name, scene);
    const auto is_there = [&](const SensorScan& scan) { return trials.count(scan.sensor) > 0; };
    if (!std::all_of(scene.sensors.begin(), scene.sensors.end(), is_there)) continue;
    write_png(path, drawn(experiment, scene, trials));
    return scene.name;
  }
  return "";
}

}  // namespace croon::experiments
