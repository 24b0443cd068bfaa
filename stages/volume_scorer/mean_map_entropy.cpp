#include <cmath>

#include "framework/stage/joint_neighbourhoods.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct Params : NeighbourhoodOptions {};

const params::Table<Params>& table() {
  static const params::Table<Params> table = params::Table<Params>().inherit(neighbourhood_table());
  return table;
}

/// exp(h) of the entropy `h = 1/2 ln det(2 pi e C)` of a normal density with the covariance C.
double volume_of_entropy(const Eigen::Matrix3d& covariance, const NeighbourhoodOptions&) {
  return std::sqrt((2.0 * M_PI * M_E * covariance).determinant());
}

class MeanMapEntropy final : public VolumeScorer {
 public:
  explicit MeanMapEntropy(const Params& params) : params_(params) {}

  /// The exponential of the mean entropy is the geometric mean of these volumes.
  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    return volume_of_neighbourhoods(target, source, params_, volume_of_entropy,
                                    NeighbourhoodMean::geometric);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry mean_map_entropy() {
  return stage_entry<MeanMapEntropy>(
      "mean_map_entropy",
      "The exponential of the mean entropy of the points around each point: a volume that is "
      "smooth in the pose.",
      "Razlaw, Droeschel, Holz and Behnke, Evaluation of registration methods for sparse 3D laser "
      "scans, ECMR 2015",
      table());
}

}  // namespace croon::stages::volume_scorer
