#include "framework/pipeline/point_selection.hpp"

#include "framework/base/error.hpp"

namespace croon {

SelectedClouds selected_clouds(const Estimate& estimate, Points points) {
  SelectedClouds clouds{estimate.target, estimate.source};
  if (points == Points::non_ground && estimate.target_ground && estimate.source_ground) {
    clouds = {estimate.target_ground->non_ground, estimate.source_ground->non_ground};
  }
  const std::string left = " has no points left (" + params::word_of(kPointsWords, points) + ")";
  if (clouds.target->empty()) throw StageError("the reference" + left);
  if (clouds.source->empty()) throw StageError("the sensor" + left);
  return clouds;
}

}  // namespace croon
