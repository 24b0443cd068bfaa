// What does a simulated scene cost: its meshes with the tree over them, and each sensor's scan?

#include <memory>
#include <stdexcept>

#include "benchmarks/support/run.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::benchmarks {
namespace {

using simulation::Recipe;
using simulation::SimulatedScene;

/// The number of scenes per kind, which are measured in turn, since scenes differ.
constexpr std::uint64_t kScenes = 8;

void measure_building(benchmark::State& state, const std::shared_ptr<const Recipe>& recipe) {
  std::uint64_t index = 0;
  std::size_t triangles = 0;
  for (auto _ : state) {
    const SimulatedScene scene(recipe, index++ % kScenes);
    triangles += scene.world().fixed.triangles.size();
  }
  state.counters["triangles"] =
      static_cast<double>(triangles) / static_cast<double>(state.iterations());
}

/// Measures the total cost of a scene in a run.
void measure_scene(benchmark::State& state, const std::shared_ptr<const Recipe>& recipe) {
  std::uint64_t index = 0;
  std::size_t points = 0;
  for (auto _ : state) {
    const SimulatedScene scene(recipe, index++ % kScenes);
    for (const auto& [name, mounting] : recipe->rig.sensors) {
      points += scene.scan_of(name).points.size();
    }
  }
  state.counters["points"] = static_cast<double>(points) / static_cast<double>(state.iterations());
}

void measure_scan(benchmark::State& state, const std::shared_ptr<const Recipe>& recipe,
                  const std::string& sensor) {
  const SimulatedScene scene(recipe, 0);
  for (auto _ : state) benchmark::DoNotOptimize(scene.scan_of(sensor).points.size());
}

void check_and_add() {
  for (std::size_t i = 0; i < simulation::kSceneKinds.size(); ++i) {
    const auto kind = static_cast<simulation::SceneKind>(i);
    const std::string name = simulation::kSceneKinds[i].name;
    const auto recipe = test::recipe_of(kind);
    if (simulation::scene_kind(*recipe, 0) != kind) {
      throw std::logic_error("the mix does not produce " + name);
    }
    add("building/" + name, benchmark::kMillisecond,
        [recipe](benchmark::State& state) { measure_building(state, recipe); });
    add("scene/" + name, benchmark::kMillisecond,
        [recipe](benchmark::State& state) { measure_scene(state, recipe); });
  }
  const auto noisy = test::recipe_of(simulation::SceneKind::urban, simulation::real_noise());
  add("scene/urban/real_noise", benchmark::kMillisecond,
      [noisy](benchmark::State& state) { measure_scene(state, noisy); });
  for (const auto& [sensor, mounting] : noisy->rig.sensors) {
    add("scan/urban/" + sensor, benchmark::kMillisecond,
        [recipe = test::recipe_of(simulation::SceneKind::urban),
         name = sensor](benchmark::State& state) { measure_scan(state, recipe, name); });
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
