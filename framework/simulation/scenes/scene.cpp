#include "framework/simulation/scenes/scene.hpp"

#include <stdexcept>

namespace croon::simulation {

Mix paper_mix() {
  Mix mix;
  for (std::size_t i = 0; i < kSceneKinds.size(); ++i) mix.weights[i] = kSceneKinds[i].paper_weight;
  return mix;
}

Mix mix_of(SceneKind kind) {
  Mix mix;
  mix[kind] = 1.0;
  return mix;
}

SceneKind draw_kind(const Mix& mix, Rng& rng) {
  double total = 0.0;
  for (const double weight : mix.weights) total += weight;
  if (!(total > 0.0)) throw std::logic_error("draw_kind: no weight is positive");
  double draw = rng.uniform(0.0, total);
  std::size_t last = 0;
  for (std::size_t kind = 0; kind < kSceneKinds.size(); ++kind) {
    const double weight = mix.weights[kind];
    if (weight <= 0.0) continue;
    last = kind;
    if (draw < weight) break;
    draw -= weight;
  }
  return static_cast<SceneKind>(last);
}

}  // namespace croon::simulation
