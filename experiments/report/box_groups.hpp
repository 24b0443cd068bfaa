#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {

/// One box per DOF: its name, its colour, its deviations.
struct BoxSeries {
  std::string label;       ///< Scene, kind or variant; empty if a group has one box alone.
  std::size_t colour = 0;  ///< The same for the same label in every group.
  std::vector<Measures> deviations;
};

/// The boxes of one sensor.
struct BoxGroup {
  std::string sensor;
  std::vector<BoxSeries> boxes;
};

/// What each box of a sensor is for.
enum class BoxOf { variant, scene, scene_kind, all_scenes };

/// With several variants a box for each, else one for each scene; of more than `max_scenes`, one
/// for each kind of scene; without kinds, or with more than
/// `max_kinds`, one for all scenes.
BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds);

/// The boxes of each sensor; a box without values has no deviations.
std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of);

}  // namespace croon::experiments
