#include "framework/simulation/scene_kind.hpp"

#include <stdexcept>

namespace croon::simulation {

Mix paper_mix() {
  Mix mix;
  mix.urban = 42.0;
  mix.suburban = 24.0;
  mix.highway = 5.0;
  mix.crossing = 18.0;
  mix.car_park = 5.7;
  mix.empty = 1.5;
  mix.narrow = 1.3;
  mix.blocked = 1.5;
  mix.corridor = 1.0;
  return mix;
}

SceneKind draw_kind(const Mix& mix, Rng& rng) {
  const std::array<double, kSceneKinds> weights = mix.weights();
  double total = 0.0;
  for (const double weight : weights) total += weight;
  if (!(total > 0.0)) throw std::logic_error("draw_kind: no weight is positive");
  double draw = rng.uniform(0.0, total);
  std::size_t kind = 0;
  std::size_t last = 0;
  for (; kind < kSceneKinds; ++kind) {
    if (weights[kind] <= 0.0) continue;
    last = kind;
    if (draw < weights[kind]) break;
    draw -= weights[kind];
  }
  return static_cast<SceneKind>(last);
}

}  // namespace croon::simulation
