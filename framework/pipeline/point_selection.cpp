#include "framework/pipeline/point_selection.hpp"

#include "framework/base/error.hpp"

namespace croon {

SelectedClouds selected_clouds(const Estimate& estimate, const std::string& points) {
  SelectedClouds clouds{estimate.target, estimate.source};
  if (points == "non_ground" && estimate.target_ground && estimate.source_ground) {
    clouds = {estimate.target_ground->non_ground, estimate.source_ground->non_ground};
  }
  if (clouds.target->empty()) throw StageError("the reference has no points left (" + points + ")");
  if (clouds.source->empty()) throw StageError("the sensor has no points left (" + points + ")");
  return clouds;
}

}  // namespace croon
