#pragma once

#include <array>
#include <string>

#include "framework/base/rng.hpp"

namespace croon::simulation {

/// The kinds of scenes, the paper's hard ones last.
enum class SceneKind {
  urban,
  suburban,
  highway,
  crossing,
  car_park,
  empty,
  narrow,
  blocked,
  corridor
};

constexpr std::size_t kSceneKinds = 9;

/// The word of each kind, in the order of the enumeration.
constexpr std::array<const char*, kSceneKinds> kSceneKindNames = {
    "urban", "suburban", "highway", "crossing", "car_park",
    "empty", "narrow",   "blocked", "corridor"};

/// How often each kind comes: weights, of which at least one is positive.
struct Mix {
  double urban = 0.0;
  double suburban = 0.0;
  double highway = 0.0;
  double crossing = 0.0;
  double car_park = 0.0;
  double empty = 0.0;
  double narrow = 0.0;
  double blocked = 0.0;
  double corridor = 0.0;

  /// The weights in the order of SceneKind.
  std::array<double, kSceneKinds> weights() const {
    return {urban, suburban, highway, crossing, car_park, empty, narrow, blocked, corridor};
  }
};

/// The mix with the share of hard scenes that the paper reports: 101 of 1899.
Mix paper_mix();

/// One kind, drawn by the weights.
SceneKind draw_kind(const Mix& mix, Rng& rng);

}  // namespace croon::simulation
