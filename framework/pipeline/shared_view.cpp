#include "framework/pipeline/shared_view.hpp"

namespace croon {

std::shared_ptr<const SensorView> shared_view(const Cloud& cloud,
                                              const params::Slot<Preprocessor>& thinning) {
  constexpr int kImageCells = 90;
  constexpr int kNormals = 10;
  constexpr int kPoints = 1500;
  const std::string what = "sensor_view";
  return cloud.once<SensorView>(what, thinning.resolved(), [&] {
    auto thinned = cloud.derived(thinning->apply(cloud.with_channels()), what);
    return std::make_shared<const SensorView>(
        SensorView{thinned, RangeImage(cloud.points(), kImageCells), kNormals,
                   balanced_sample(*thinned, kNormals, kPoints)});
  });
}

}  // namespace croon
