#pragma once

#include <memory>
#include <string>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/table.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon {

/// Which neighbourhoods of two clouds are measured.
struct NeighbourhoodOptions {
  double radius_m = 0.3;
  double noise_m = 0.01;
  int max_points = 1500;
};

/// The rows of NeighbourhoodOptions.
const params::Table<NeighbourhoodOptions>& neighbourhood_table();

/// What the covariance of a neighbourhood (3×3, m^2) stands for, a volume in m^3.
using NeighbourhoodMeasure = double (*)(const Eigen::Matrix3d& covariance,
                                        const NeighbourhoodOptions& options);

/// How the measures of all neighbourhoods become one.
enum class NeighbourhoodMean { arithmetic, geometric };

/// The mean of `measure` over the neighbourhoods of a sample of the source's points, as a function
/// of pose. A neighbourhood has the points of both clouds within the radius, each with the weight
/// `(1 - d^2 / radius^2)^2`, so none comes or goes with a jump; `noise_m` squared is added to its
/// covariance, so that none is flat. Surfaces of two clouds that do not align make it thicker. A
/// source without points has the volume zero.
VolumeFunction volume_of_neighbourhoods(const std::shared_ptr<const Cloud>& target,
                                        const std::shared_ptr<const Cloud>& source,
                                        const NeighbourhoodOptions& options,
                                        NeighbourhoodMeasure measure, NeighbourhoodMean mean);

/// The scorer of neighbourhoods by `Measure`, which has the stage's name `kName`, its
/// NeighbourhoodMean `kMean` and its NeighbourhoodMeasure `volume_m3`.
template <class Measure>
class NeighbourhoodScorer final : public VolumeScorer {
 public:
  explicit NeighbourhoodScorer(const NeighbourhoodOptions& options) : options_(options) {}

  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    return volume_of_neighbourhoods(target, source, options_, Measure::volume_m3, Measure::kMean);
  }

 private:
  NeighbourhoodOptions options_;
};

/// The entry of that scorer. The rest is as in stage_entry.
template <class Measure>
StageEntry neighbourhood_scorer_entry(const std::string& summary, const std::string& source,
                                      int version = 1) {
  return stage_entry<NeighbourhoodScorer<Measure>>(Measure::kName, summary, source,
                                                   neighbourhood_table(), version);
}

}  // namespace croon
