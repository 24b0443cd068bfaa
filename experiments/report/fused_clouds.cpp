#include "experiments/report/fused_clouds.hpp"

#include <map>
#include <tuple>

#include "experiments/run/sensor_pairs.hpp"
#include "framework/base/error.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/vdb_writer.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr double kLeafSize_m = 0.05;

/// Estimates by variant, scene and sensor.
using Estimates = std::map<std::tuple<std::string, std::string, std::string>, RigidTransform>;

Estimates first_estimates(const std::vector<TrialRecord>& records) {
  Estimates estimates;
  for (const TrialRecord& record : records) {
    if (!record.T_reference_sensor) continue;
    // emplace keeps the first, and records are sorted by trial.
    estimates.emplace(std::tuple(record.id.variant, record.id.scene, record.id.sensor),
                      *record.T_reference_sensor);
  }
  return estimates;
}

/// The points of `scan`; none if it cannot be read, which is the reason of its failed trials.
PointCloud points_of(const SensorScan& scan) {
  try {
    return scan.load().points;
  } catch (const InputError&) {
    return {};
  }
}

void write_scene(const std::vector<ColouredCloud>& clouds, const fs::path& stem) {
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

/// Writes what can be written. Returns why not all: a pose may be farther off than leaves can be.
std::string try_to_write_scene(const std::vector<ColouredCloud>& clouds, const fs::path& stem) {
  try {
    write_scene(clouds, stem);
    return "";
  } catch (const StageError& error) {
    return stem.string() + ".vdb: not written: " + error.what();
  }
}

}  // namespace

std::vector<std::string> write_fused_clouds(const Experiment& experiment,
                                            const std::vector<Scene>& scenes,
                                            const std::vector<TrialRecord>& records,
                                            const fs::path& folder) {
  const Estimates estimates = first_estimates(records);
  std::vector<std::string> complaints;
  for (const Scene& scene : without_pairs(scenes)) {
    const PointCloud reference = points_of(scene.reference);
    std::vector<PointCloud> points;
    for (const SensorScan& scan : scene.sensors) points.push_back(points_of(scan));
    for (const Variant& variant : experiment.variants) {
      std::vector<ColouredCloud> clouds = {{scene.reference.sensor, reference, {}}};
      for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
        const std::string& sensor = scene.sensors[i].sensor;
        const auto found = estimates.find(std::tuple(variant.name, scene.name, sensor));
        if (found != estimates.end()) clouds.push_back({sensor, points[i], found->second});
      }
      if (clouds.size() == 1) continue;
      const std::string why_not = try_to_write_scene(clouds, folder / variant.name / scene.name);
      if (!why_not.empty()) complaints.push_back(why_not);
    }
  }
  return complaints;
}

}  // namespace croon::experiments
