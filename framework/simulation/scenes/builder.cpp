#include "framework/simulation/scenes/builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace croon::simulation {
namespace {

/// How long a scan takes at most: what moves needs the way of that time too.
constexpr double kScan_s = 0.15;

/// The box of the car with the room around it that stays empty.
RoadBox car_box(const Place& place, const CarSpace& space, double speed_mps) {
  constexpr double kMargin_m = 0.5;
  const double half_length_m = 0.5 * space.length_m + kMargin_m;
  const double half_width_m = 0.5 * space.width_m + kMargin_m;
  const double cosine = std::abs(std::cos(place.yaw_rad));
  const double sine = std::abs(std::sin(place.yaw_rad));
  const double along_m = half_length_m * cosine + half_width_m * sine;
  const double across_m = half_length_m * sine + half_width_m * cosine;
  return road_box({place.s_m - along_m, place.s_m + along_m + kScan_s * speed_mps},
                  {place.d_m - across_m, place.d_m + across_m}, kHeadroom_m);
}

/// The least ground height under the boxes.
double lowest_ground_m(const Ground& ground, const std::array<RoadBox, 2>& boxes) {
  const RoadBox& box = boxes[0].isEmpty() ? boxes[1] : boxes[0];
  double lowest_m = ground.height_m(box.min().x(), box.min().y());
  for (const double s_m : {box.min().x(), box.max().x()}) {
    for (const double d_m : {box.min().y(), box.max().y()}) {
      lowest_m = std::min(lowest_m, ground.height_m(s_m, d_m));
    }
  }
  return lowest_m;
}

}  // namespace

SceneBuilder::SceneBuilder(const RoadShape& shape, const StreamKey& key)
    : key_(key), ground_(shape, key.with("ground")) {
  ground_.add_to(world_.fixed);
}

Motion SceneBuilder::motion_at(const Place& place, double speed_mps) const {
  const double curvature_per_m = shape().curvature_per_m;
  const double own_per_m =
      std::cos(place.yaw_rad) * curvature_per_m / (1.0 - curvature_per_m * place.d_m);
  return {speed_mps, speed_mps * own_per_m};
}

void SceneBuilder::put_car(const Place& place, const CarSpace& space, double speed_mps,
                           double turn_rate_radps) {
  world_.car.T_world_body = ground_.on_slope(place.s_m, place.d_m, place.yaw_rad);
  world_.car.motion = motion_at(place, speed_mps);
  world_.car.motion.yaw_rate_radps += turn_rate_radps;
  keep_clear(car_box(place, space, speed_mps));
}

bool SceneBuilder::take_all(const std::array<RoadBox, 2>& boxes) {
  for (const RoadBox& box : boxes) {
    if (!box.isEmpty() && !is_free(box)) return false;
  }
  for (const RoadBox& box : boxes) {
    if (!box.isEmpty()) keep_clear(box);
  }
  return true;
}

bool SceneBuilder::take(const RoadBox& box) { return take_all({box, RoadBox()}); }

bool SceneBuilder::stand(const Mesh& mesh, const Place& place) {
  const std::array<RoadBox, 2> boxes = boxes_of(mesh, place, shape().curvature_per_m);
  if (!take_all(boxes)) return false;
  RigidTransform pose = ground_.upright(place.s_m, place.d_m, place.yaw_rad);
  pose.translation.z() = std::min(pose.translation.z(), lowest_ground_m(ground_, boxes));
  world_.fixed.append(mesh, pose);
  return true;
}

bool SceneBuilder::park(const Mesh& mesh, const Place& place) {
  if (!take_all(boxes_of(mesh, place, shape().curvature_per_m))) return false;
  world_.fixed.append(mesh, ground_.on_slope(place.s_m, place.d_m, place.yaw_rad));
  return true;
}

bool SceneBuilder::drive(Mesh mesh, const Place& place, double speed_mps) {
  std::array<RoadBox, 2> boxes = boxes_of(mesh, place, shape().curvature_per_m);
  const Eigen::Vector3d way =
      kScan_s * speed_mps * Eigen::Vector3d(std::cos(place.yaw_rad), std::sin(place.yaw_rad), 0.0);
  for (RoadBox& box : boxes) {
    if (!box.isEmpty()) box.extend(RoadBox(box.min() + way, box.max() + way));
  }
  if (!take_all(boxes)) return false;
  world_.bodies.push_back({std::move(mesh), ground_.on_slope(place.s_m, place.d_m, place.yaw_rad),
                           motion_at(place, speed_mps)});
  return true;
}

World SceneBuilder::finish() { return std::move(world_); }

}  // namespace croon::simulation
