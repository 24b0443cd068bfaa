#include "framework/simulation/simulated_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/simulation/own_car.hpp"
#include "framework/simulation/scenes/scene.hpp"

namespace croon::simulation {
namespace {

StreamKey scene_key(const Recipe& recipe, std::uint64_t index) {
  return StreamKey(static_cast<std::uint64_t>(recipe.seed)).with("simulated scene").with(index);
}

std::shared_ptr<const World> make_world(const Recipe& recipe, std::uint64_t index) {
  const CarBody& body = recipe.rig.body;
  World world = make_scene(scene_kind(recipe, index), {body.length_m, body.width_m},
                           scene_key(recipe, index).with("world"));
  world.car.mesh = make_own_car(body);
  return std::make_shared<const World>(std::move(world));
}

/// From the first ray of any sensor to the last; one instant where nothing moves meanwhile.
TimeWindow window_of(const Recipe& recipe) {
  TimeWindow window;
  if (!recipe.noise.sweep_distortion) return window;
  for (const auto& [name, mounting] : recipe.rig.sensors) {
    window.begin_s = std::min(window.begin_s, mounting.time_offset_s);
    window.end_s = std::max(window.end_s, mounting.time_offset_s + mounting.model.period_s);
  }
  return window;
}

const Mounting& mounting_of(const Rig& rig, const std::string& name) {
  for (const auto& [sensor, mounting] : rig.sensors) {
    if (sensor == name) return mounting;
  }
  throw std::logic_error("the rig has no sensor " + name);
}

}  // namespace

SceneKind scene_kind(const Recipe& recipe, std::uint64_t index) {
  Rng rng(scene_key(recipe, index).with("kind"));
  return draw_kind(recipe.mix, rng);
}

SimulatedScene::SimulatedScene(std::shared_ptr<const Recipe> recipe, std::uint64_t index)
    : recipe_(std::move(recipe)),
      key_(scene_key(*recipe_, index)),
      world_(make_world(*recipe_, index)),
      caster_(world_, window_of(*recipe_)) {}

MeasuredCloud SimulatedScene::sweep_of(const std::string& name) const {
  const Mounting& mounting = mounting_of(recipe_->rig, name);
  const RigidTransform T_car_sensor =
      recipe_->rig.T_car_reference() * mounting.T_reference_sensor();
  const SweepPlan plan = {mounting.time_offset_s, [&](double time_s) {
                            return world_->car.pose_at(time_s) * T_car_sensor;
                          }};
  return sweep(caster_, mounting.model, recipe_->noise, plan, key_.with("sweep").with(name));
}

Image bird_view(const SimulatedScene& scene) {
  // Low and over the car's axis, so that it is also inside of a tunnel and between close walls.
  const RigidTransform& T_world_car = scene.world().car.T_world_body;
  return render(scene.caster(), looking_at(T_world_car * Eigen::Vector3d(-10.5, 0.0, 4.3),
                                           T_world_car * Eigen::Vector3d(10.0, 0.0, 0.5)));
}

}  // namespace croon::simulation
