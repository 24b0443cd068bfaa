#pragma once

#include <memory>
#include <string>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/table.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon {

/// The neighbourhoods of two clouds that are measured.
struct NeighbourhoodOptions {
  double radius_m = 0.3;
  double noise_m = 0.01;
  int max_points = 1500;
};

/// The rows of NeighbourhoodOptions.
const params::Table<NeighbourhoodOptions>& neighbourhood_table();

/// Converts the covariance of a neighbourhood (3×3, m^2) to a volume in m^3.
using NeighbourhoodMeasure = double (*)(const Eigen::Matrix3d& covariance,
                                        const NeighbourhoodOptions& options);

/// How the measures of all neighbourhoods are averaged.
enum class NeighbourhoodMean { arithmetic, geometric };

/// The mean of `measure` over the neighbourhoods of a sample of the source's points, as a function
/// of pose. A neighbourhood consists of the points of both clouds within the radius, with the
/// weight `(1 - d^2 / radius^2)^2`, so that points enter and leave continuously; `noise_m` squared
/// is added to its covariance, so that none is flat. Misaligned surfaces of two clouds increase its
/// thickness. The volume of a source without points is zero.
VolumeFunction volume_of_neighbourhoods(const std::shared_ptr<const Cloud>& target,
                                        const std::shared_ptr<const Cloud>& source,
                                        const NeighbourhoodOptions& options,
                                        NeighbourhoodMeasure measure, NeighbourhoodMean mean);

/// The scorer of neighbourhoods by `Measure`, which defines the stage's name `kName`, its
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

/// The entry of that scorer. The other arguments are as in stage_entry.
template <class Measure>
StageEntry neighbourhood_scorer_entry(const std::string& summary, const std::string& source,
                                      int version = 1) {
  return stage_entry<NeighbourhoodScorer<Measure>>(Measure::kName, summary, source,
                                                   neighbourhood_table(), version);
}

}  // namespace croon
