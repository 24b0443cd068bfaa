#include <algorithm>
#include <cmath>

#include "framework/stage/joint_neighbourhoods.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct MeanMapEntropy {
  static constexpr const char* kName = "mean_map_entropy";
  /// The exponential of a mean of entropies is the geometric mean of their volumes.
  static constexpr NeighbourhoodMean kMean = NeighbourhoodMean::geometric;

  /// exp(h) of the entropy `h = 1/2 ln det(2 pi e C)` of a normal density with the covariance C.
  static double volume_m3(const Eigen::Matrix3d& covariance, const NeighbourhoodOptions& options) {
    constexpr double kOfVariance = 2.0 * M_PI * M_E;
    // No variance is below that of the noise, but rounding may make the determinant negative.
    const double min_determinant = std::pow(kOfVariance * options.noise_m * options.noise_m, 3);
    return std::sqrt(std::max((kOfVariance * covariance).determinant(), min_determinant));
  }
};

}  // namespace

StageEntry mean_map_entropy() {
  return neighbourhood_scorer_entry<MeanMapEntropy>(
      "The exponential of the mean entropy of each point's neighbourhood: a volume that is smooth "
      "in the pose.",
      "Razlaw, Droeschel, Holz and Behnke, Evaluation of registration methods for sparse 3D laser "
      "scans, ECMR 2015");
}

}  // namespace croon::stages::volume_scorer
