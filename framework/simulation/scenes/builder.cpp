#include "framework/simulation/scenes/builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

/// Maximum duration of a scan, during which moving objects occupy their path.
constexpr double kScan_s = 0.15;

/// The box of the car with a margin that is kept clear.
RoadBox car_box(const RoadPose& pose, const CarBody& body, double speed_mps) {
  constexpr double kMargin_m = 0.5;
  const double half_length_m = 0.5 * body.length_m + kMargin_m;
  const double half_width_m = 0.5 * body.width_m + kMargin_m;
  const double cosine = std::abs(std::cos(pose.yaw_rad));
  const double sine = std::abs(std::sin(pose.yaw_rad));
  const double along_m = half_length_m * cosine + half_width_m * sine;
  const double across_m = half_length_m * sine + half_width_m * cosine;
  return road_box({pose.s_m - along_m, pose.s_m + along_m + kScan_s * speed_mps},
                  {pose.d_m - across_m, pose.d_m + across_m}, kHeadroom_m);
}

/// The minimum height of the ground under the boxes.
double lowest_ground_m(const Ground& ground, const std::array<RoadBox, 2>& boxes) {
  const RoadBox& box = boxes[0].isEmpty() ? boxes[1] : boxes[0];
  double lowest_m = ground.shape().height_m(box.min().x(), box.min().y());
  for (const double s_m : {box.min().x(), box.max().x()}) {
    for (const double d_m : {box.min().y(), box.max().y()}) {
      lowest_m = std::min(lowest_m, ground.shape().height_m(s_m, d_m));
    }
  }
  return lowest_m;
}

}  // namespace

SceneBuilder::SceneBuilder(const RoadShape& shape, const StreamKey& key)
    : key_(key), ground_(shape, key.with("ground")) {
  ground_.add_to(world_.fixed);
}

Motion SceneBuilder::motion_at(const RoadPose& pose, double speed_mps) const {
  const double curvature_per_m = shape().curvature_per_m;
  const double own_per_m =
      std::cos(pose.yaw_rad) * curvature_per_m / (1.0 - curvature_per_m * pose.d_m);
  return {speed_mps, speed_mps * own_per_m};
}

void SceneBuilder::put_car(const RoadPose& pose, const CarBody& body, double speed_mps,
                           double turn_rate_radps) {
  world_.car.T_world_body = ground_.on_slope(pose.s_m, pose.d_m, pose.yaw_rad);
  world_.car.motion = motion_at(pose, speed_mps);
  world_.car.motion.yaw_rate_radps += turn_rate_radps;
  keep_clear(car_box(pose, body, speed_mps));
}

bool SceneBuilder::occupy_all(const std::array<RoadBox, 2>& boxes) {
  for (const RoadBox& box : boxes) {
    if (!box.isEmpty() && !is_free(box)) return false;
  }
  for (const RoadBox& box : boxes) {
    if (!box.isEmpty()) keep_clear(box);
  }
  return true;
}

bool SceneBuilder::occupy(const RoadBox& box) { return occupy_all({box, RoadBox()}); }

bool SceneBuilder::place_upright(const Mesh& mesh, const RoadPose& pose) {
  const std::array<RoadBox, 2> boxes = boxes_of(mesh, pose, shape().curvature_per_m);
  if (!occupy_all(boxes)) return false;
  RigidTransform T_world_mesh = ground_.upright(pose.s_m, pose.d_m, pose.yaw_rad);
  T_world_mesh.translation.z() =
      std::min(T_world_mesh.translation.z(), lowest_ground_m(ground_, boxes));
  add(mesh, T_world_mesh);
  return true;
}

bool SceneBuilder::park(const Mesh& mesh, const RoadPose& pose) {
  if (!occupy_all(boxes_of(mesh, pose, shape().curvature_per_m))) return false;
  add(mesh, ground_.on_slope(pose.s_m, pose.d_m, pose.yaw_rad));
  return true;
}

bool SceneBuilder::drive(Mesh mesh, const RoadPose& pose, double speed_mps) {
  std::array<RoadBox, 2> boxes = boxes_of(mesh, pose, shape().curvature_per_m);
  const Eigen::Vector3d way =
      kScan_s * speed_mps * Eigen::Vector3d(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad), 0.0);
  for (RoadBox& box : boxes) {
    if (!box.isEmpty()) box.extend(RoadBox(box.min() + way, box.max() + way));
  }
  if (!occupy_all(boxes)) return false;
  world_.bodies.push_back({std::move(mesh), ground_.on_slope(pose.s_m, pose.d_m, pose.yaw_rad),
                           motion_at(pose, speed_mps)});
  return true;
}

World SceneBuilder::finish() { return std::move(world_); }

void add_series(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                const Series& series, Rng rng) {
  std::vector<Mesh> meshes;
  for (int i = 0; i < series.meshes; ++i) meshes.push_back(series.make(rng));
  double position_m = along_m.from + rng.uniform(0.0, series.spacing_m.from);
  while (position_m < along_m.to) {
    const double out_m = draw(rng, series.out_m);
    const double turn_rad = series.has_random_turn ? rng.uniform(0.0, 2.0 * kPi) : series.turn_rad;
    if (chance(rng, series.share)) {
      builder.place_upright(pick(meshes, rng), side.at(position_m, out_m, turn_rad));
    }
    position_m += draw(rng, series.spacing_m);
  }
}

Mesh centred_along_x(Mesh mesh) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices) bounds.extend(vertex);
  const float middle_m = bounds.center().x();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.x() -= middle_m;
  return mesh;
}

}  // namespace croon::simulation
