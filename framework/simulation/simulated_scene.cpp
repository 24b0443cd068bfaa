#include "framework/simulation/simulated_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// The number of the scan `index` in its drive.
std::uint64_t scan_in_drive(const Recipe& recipe, std::uint64_t index) {
  return index % static_cast<std::uint64_t>(recipe.scans_per_drive);
}

/// The time of the scan `index` after the beginning of its drive.
double begin_of(const Recipe& recipe, std::uint64_t index) {
  return recipe.scan_interval_s * static_cast<double>(scan_in_drive(recipe, index));
}

/// The key of the drive with the scan `index`.
StreamKey scene_key(const Recipe& recipe, std::uint64_t index) {
  return StreamKey(static_cast<std::uint64_t>(recipe.seed))
      .with("simulated scene")
      .with(index / static_cast<std::uint64_t>(recipe.scans_per_drive));
}

/// The key of the errors of the scan `index`.
StreamKey sweep_key(const Recipe& recipe, std::uint64_t index) {
  const StreamKey key = scene_key(recipe, index).with("sweep");
  const std::uint64_t scan = scan_in_drive(recipe, index);
  return scan == 0 ? key : key.with("scan").with(scan);
}

/// `motion` at another speed, on the same arc unless a car could not reach that lateral
/// acceleration. A stationary car drives straight on.
Motion at_speed(const Motion& motion, double speed_mps) {
  constexpr double kMaxLateral_mps2 = 4.0;
  if (motion.speed_mps == 0.0 || speed_mps == 0.0) return {speed_mps, 0.0};
  const double max_radps = kMaxLateral_mps2 / speed_mps;
  const double turn_radps = motion.yaw_rate_radps / motion.speed_mps * speed_mps;
  return {speed_mps, std::clamp(turn_radps, -max_radps, max_radps)};
}

std::shared_ptr<const World> make_world(const Recipe& recipe, std::uint64_t index) {
  const CarBody& body = recipe.rig.body;
  World world = make_scene(scene_kind(recipe, index), body, scene_key(recipe, index).with("world"));
  world.car.mesh = make_own_car(body);
  if (recipe.speed_mps >= 0.0) {
    world.car.motion = at_speed(world.car.motion, recipe.speed_mps);
  }
  if (const double begin_s = begin_of(recipe, index); begin_s > 0.0) {
    world.car.T_world_body = world.car.pose_at(begin_s);
    for (Body& other : world.bodies) other.T_world_body = other.pose_at(begin_s);
  }
  return std::make_shared<const World>(std::move(world));
}

/// The time from the first ray of any sensor to the last; {0, 0} if nothing moves during a scan.
Span window_of(const Recipe& recipe) {
  Span window_s;
  if (!recipe.noise.moves_during_scan) return window_s;
  for (const auto& [name, mounting] : recipe.rig.sensors) {
    window_s.from = std::min(window_s.from, mounting.time_offset_s);
    window_s.to = std::max(window_s.to, mounting.time_offset_s + mounting.model.period_s);
  }
  return window_s;
}

const Mounting& mounting_of(const Rig& rig, const std::string& name) {
  for (const auto& [sensor, mounting] : rig.sensors) {
    if (sensor == name) return mounting;
  }
  throw std::logic_error("the rig has no sensor " + name);
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
}

Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  const auto mix = [&](std::uint8_t x, std::uint8_t y) {
    return channel((1.0 - share_of_b) * x + share_of_b * y);
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

/// The colour of a pixel: surfaces are brightest if they face the camera, and fade into haze with
/// distance.
Colour colour_of(const Hit& hit) {
  const Colour haze = {206, 222, 236};
  if (!hit.is_there()) return haze;
  const Colour& own = look_of(hit.material).colour;
  const double light = 0.45 + 0.6 * hit.incidence_cos;
  const Colour lit = {channel(light * own.red), channel(light * own.green),
                      channel(light * own.blue)};
  return mixed(lit, haze, 0.8 * (1.0 - std::exp(-hit.range_m / 150.0)));
}

/// The pose of a camera at `eye` that looks at `target`. Camera frame: x along the view, y to the
/// left, z up.
RigidTransform looking_at(const Vector3d& eye, const Vector3d& target) {
  RigidTransform T_world_camera;
  const Vector3d forward = (target - eye).normalized();
  const Vector3d left = Vector3d::UnitZ().cross(forward).normalized();
  T_world_camera.rotation << forward, left, forward.cross(left);
  T_world_camera.translation = eye;
  return T_world_camera;
}

}  // namespace

SceneKind scene_kind(const Recipe& recipe, std::uint64_t index) {
  Rng rng(scene_key(recipe, index).with("kind"));
  return draw_kind(recipe.mix, rng);
}

SimulatedScene::SimulatedScene(std::shared_ptr<const Recipe> recipe, std::uint64_t index)
    : recipe_(std::move(recipe)),
      key_(sweep_key(*recipe_, index)),
      begin_s_(begin_of(*recipe_, index)),
      world_(make_world(*recipe_, index)),
      caster_(world_, window_of(*recipe_)) {}

PointCloud SimulatedScene::scan_of(const std::string& name) const {
  const Mounting& mounting = mounting_of(recipe_->rig, name);
  const RigidTransform T_car_sensor =
      recipe_->rig.T_car_reference() * mounting.T_reference_sensor();
  const double clock_offset_s =
      name == recipe_->rig.reference ? 0.0 : recipe_->noise.clock_offset_s;
  const ScanPlan plan = {mounting.time_offset_s,
                         [&](double time_s) { return world_->car.pose_at(time_s) * T_car_sensor; },
                         begin_s_ + clock_offset_s};
  // The name of the random stream determines the bits of all scans.
  return scan(caster_, mounting.model, recipe_->noise, plan, key_.with(name));
}

Twist SimulatedScene::velocity_of(const std::string& name) const {
  if (!recipe_->noise.moves_during_scan) return {};
  const RigidTransform T_car_sensor =
      recipe_->rig.T_car_reference() * mounting_of(recipe_->rig, name).T_reference_sensor();
  const Motion& motion = world_->car.motion;
  return velocity_in(T_car_sensor.inverse(),
                     {{0.0, 0.0, motion.yaw_rate_radps}, {motion.speed_mps, 0.0, 0.0}});
}

Image SimulatedScene::picture() const {
  constexpr int kWidth = 800;
  constexpr int kHeight = 500;
  constexpr double kWidth_deg = 75.0;
  constexpr double kFar_m = 400.0;
  // The camera is low and above the car's axis, so that tunnels and close walls do not hide the
  // scene.
  const RigidTransform& T_world_car = world_->car.T_world_body;
  const RigidTransform T_world_camera =
      looking_at(T_world_car * Vector3d(-10.5, 0.0, 4.3), T_world_car * Vector3d(10.0, 0.0, 0.5));
  const double focal_px = 0.5 * kWidth / std::tan(0.5 * rad_from_deg(kWidth_deg));
  std::vector<Ray> rays;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Vector3d through(focal_px, 0.5 * kWidth - x - 0.5, 0.5 * kHeight - y - 0.5);
      rays.push_back(
          {T_world_camera.translation, T_world_camera.rotation * through.normalized(), 0.0});
    }
  }
  const std::vector<Hit> hits = caster_.cast(rays, 0.05, kFar_m);
  Image image(kWidth, kHeight);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const int pixel = static_cast<int>(i);
    image.at(pixel % kWidth, pixel / kWidth) = colour_of(hits[i]);
  }
  return image;
}

}  // namespace croon::simulation
