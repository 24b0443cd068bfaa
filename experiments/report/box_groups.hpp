#pragma once

#include <string>
#include <vector>

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// One box per DOF: what it is called, where its colour comes from, its deviations.
struct BoxSeries {
  std::string label;       ///< Scene or variant; empty where a group has one box alone.
  std::size_t colour = 0;  ///< The same for the same label in every group.
  std::vector<Measures> deviations;
};

/// The boxes of one sensor.
struct BoxGroup {
  std::string sensor;
  std::vector<BoxSeries> boxes;
};

/// What is drawn beside what: with several variants a box for each, else one for each scene; where
/// there are more than `max_scenes`, one for all of them. Boxes without a value are left out.
std::vector<BoxGroup> box_groups(const Summary& summary, std::size_t max_scenes);

}  // namespace croon::experiments
