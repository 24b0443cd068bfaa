#include <Eigen/Eigenvalues>
#include <algorithm>
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

/// A disk as wide as the neighbourhood, whose thickness t has the variance across it, t^2 / 12.
double volume_of_disk(const Eigen::Matrix3d& covariance, const NeighbourhoodOptions& options) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(covariance, Eigen::EigenvaluesOnly);
  const double variance_m2 = std::max(0.0, axes.eigenvalues()(0));
  return M_PI * options.radius_m * options.radius_m * std::sqrt(12.0 * variance_m2);
}

class MeanPlaneVariance final : public VolumeScorer {
 public:
  explicit MeanPlaneVariance(const Params& params) : params_(params) {}

  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    return volume_of_neighbourhoods(target, source, params_, volume_of_disk,
                                    NeighbourhoodMean::arithmetic);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry mean_plane_variance() {
  return stage_entry<MeanPlaneVariance>(
      "mean_plane_variance",
      "The mean thickness of the surfaces around each point, as the volume of a disk: smooth in "
      "the pose.",
      "Razlaw, Droeschel, Holz and Behnke, Evaluation of registration methods for sparse 3D laser "
      "scans, ECMR 2015",
      table());
}

}  // namespace croon::stages::volume_scorer
