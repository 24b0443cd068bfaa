#pragma once

#include <array>

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"
#include "framework/simulation/rig.hpp"

/// The kinds of scenes: the name, the weight in the mix "paper" and the description of the weight
/// in "mix". The file kinds/<name>.cpp defines make_<name>. The paper's hard kinds come last; their
/// share equals that of the paper's failures, 101 of 1899 frames.
#define CROON_SCENE_KINDS(KIND)                                           \
  KIND(urban, 42.0, "Weight of town streets.")                            \
  KIND(suburban, 24.0, "Weight of streets of family houses.")             \
  KIND(highway, 5.0, "Weight of highways.")                               \
  KIND(crossing, 18.0, "Weight of crossings in a town.")                  \
  KIND(car_park, 5.7, "Weight of car parks.")                             \
  KIND(empty, 1.5, "Weight of featureless places.")                       \
  KIND(narrow, 1.3, "Weight of alleys with walls close on both sides.")   \
  KIND(blocked, 1.5, "Weight of streets with a truck beside one sensor.") \
  KIND(corridor, 1.0, "Weight of roads between long smooth walls.")       \
  KIND(periodic, 0.0, "Weight of roads between equal niches, columns, racks or vehicles.")

namespace croon::simulation {

#define CROON_ENUMERATOR(name, weight, sentence) name,
/// The kind of a scene.
enum class SceneKind { CROON_SCENE_KINDS(CROON_ENUMERATOR) };
#undef CROON_ENUMERATOR

#define CROON_DECLARE(name, weight, sentence) World make_##name(const CarBody&, const StreamKey&);
CROON_SCENE_KINDS(CROON_DECLARE)
#undef CROON_DECLARE

/// A row of CROON_SCENE_KINDS.
struct SceneKindRow {
  const char* name;
  double paper_weight;
  const char* sentence;
  World (*make)(const CarBody& car, const StreamKey& key);
};

#define CROON_ROW(name, weight, sentence) SceneKindRow{#name, weight, sentence, make_##name},
/// The kinds of scenes by their SceneKind.
constexpr std::array kSceneKinds = {CROON_SCENE_KINDS(CROON_ROW)};
#undef CROON_ROW

/// The row of `kind`.
constexpr const SceneKindRow& row_of(SceneKind kind) {
  return kSceneKinds[static_cast<std::size_t>(kind)];
}

/// A scene of `kind` without the car that carries the sensors: `car` of the result has a pose and a
/// motion, but no mesh. The space of a body of the size `car` is free.
inline World make_scene(SceneKind kind, const CarBody& car, const StreamKey& key) {
  return row_of(kind).make(car, key);
}

/// The weights of the kinds of scenes by their SceneKind. At least one is positive.
struct Mix {
  std::array<double, kSceneKinds.size()> weights{};

  double& operator[](SceneKind kind) { return weights[static_cast<std::size_t>(kind)]; }
};

/// The mix "paper".
Mix paper_mix();

/// A mix of one kind.
Mix mix_of(SceneKind kind);

/// A random kind with probabilities in proportion to the weights.
SceneKind draw_kind(const Mix& mix, Rng& rng);

}  // namespace croon::simulation
