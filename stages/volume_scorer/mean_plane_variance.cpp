#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "framework/stage/joint_neighbourhoods.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct MeanPlaneVariance {
  static constexpr const char* kName = "mean_plane_variance";
  static constexpr NeighbourhoodMean kMean = NeighbourhoodMean::arithmetic;

  /// A disk with the neighbourhood's radius and a thickness t whose variance t^2 / 12 is that of
  /// the points.
  static double volume_m3(const Eigen::Matrix3d& covariance, const NeighbourhoodOptions& options) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(covariance, Eigen::EigenvaluesOnly);
    const double variance_m2 = std::max(0.0, axes.eigenvalues()(0));
    return M_PI * options.radius_m * options.radius_m * std::sqrt(12.0 * variance_m2);
  }
};

}  // namespace

StageEntry mean_plane_variance() {
  return neighbourhood_scorer_entry<MeanPlaneVariance>(
      "The mean thickness of the surfaces around each point, as the volume of a disk: smooth in "
      "the pose.",
      "Razlaw, Droeschel, Holz and Behnke, Evaluation of registration methods for sparse 3D laser "
      "scans, ECMR 2015");
}

}  // namespace croon::stages::volume_scorer
