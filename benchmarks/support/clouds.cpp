#include "benchmarks/support/clouds.hpp"

#include <algorithm>
#include <cstdlib>

#include "framework/calibration/extrinsics.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon::benchmarks {
namespace {

CloudPair sample(const std::string& data_root, const std::string& scene_folder) {
  const auto dataset =
      test::stage<Dataset>(R"({"type": "opencalib", "path": ")" + scene_folder + R"("})");
  const Scene scene = dataset->scenes(data_root).at(0);
  const SensorScan& sensor = scene.sensors.at(0);
  CloudPair pair;
  pair.name = scene_folder.substr(scene_folder.find('/') + 1) + "/" + sensor.sensor;
  pair.target = scene.reference.load().points;
  pair.source = sensor.load().points;
  pair.T_target_source = sensor.truth ? *sensor.truth : sensor.nominal.value();
  return pair;
}

Points without_ground(const Points& cloud) {
  Rng rng(StreamKey(1).with("ground"));
  const Ground ground = test::stage<GroundExtractor>(R"({"type": "ransac"})")->extract(cloud, rng);
  Points left;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (ground.is_ground[i] == 0) left.push_back(cloud[i]);
  }
  return left;
}

}  // namespace

CloudPair street(int target_count, int source_count) {
  Rng rng(StreamKey(1).with("street pair"));
  // Rotated like a real sensor: walls along the axes would be a special case.
  const RigidTransform T_target_street = test::random_pose(rng, 0.5);
  const RigidTransform T_target_source = test::random_pose(rng, 1.0);
  const test::StreetPair pair =
      test::street_pair(rng, 1, T_target_source, target_count, source_count, 0.01, T_target_street);
  return {"street_" + std::to_string(source_count), pair.target, pair.source, T_target_source};
}

std::vector<CloudPair> streets() {
  const char* const text = std::getenv("CROON_BENCHMARK_POINTS");
  const int most = text == nullptr ? 100000 : std::min(std::atoi(text), 10000000);
  std::vector<CloudPair> pairs;
  for (int count = 1000; count <= most; count *= 10) pairs.push_back(street(count, count));
  return pairs;
}

bool is_large(const CloudPair& pair) { return pair.source.size() > 500000; }

std::vector<CloudPair> samples() {
  const char* data_root = std::getenv("CROON_DATA");
  if (data_root == nullptr) return {};
  return {sample(data_root, "opencalib/carla/004069"), sample(data_root, "opencalib/real/0001")};
}

std::vector<CloudPair> rigs() {
  const char* data_root = std::getenv("CROON_DATA");
  if (data_root == nullptr) return {};
  const std::filesystem::path folder = std::filesystem::path(data_root) / "rigs" / "edgar";
  if (!std::filesystem::exists(folder)) return {};
  return {{"edgar/sensor_2", read_point_cloud(folder / "sensor_1" / "1.pcd").points,
           read_point_cloud(folder / "sensor_2" / "1.pcd").points,
           read_extrinsics(folder / "nominal.json").poses.at(0).T_parent_sensor}};
}

CloudPair non_ground(const CloudPair& pair) {
  return {pair.name, without_ground(pair.target), without_ground(pair.source),
          pair.T_target_source};
}

std::shared_ptr<const Cloud> fresh(const Points& points) {
  return std::make_shared<const Cloud>(points, StreamKey(1));
}

std::vector<RigidTransform> poses_near(const CloudPair& pair, int count, double rotation_deg,
                                       double translation_m) {
  Rng rng(StreamKey(1).with("poses"));
  std::vector<RigidTransform> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(test::pose_near(rng, pair.T_target_source, rotation_deg, translation_m));
  }
  return poses;
}

}  // namespace croon::benchmarks
