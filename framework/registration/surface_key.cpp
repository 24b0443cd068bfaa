#include "framework/registration/surface_key.hpp"

#include <algorithm>
#include <cmath>

namespace croon {
namespace {

constexpr int kCells =
    5;  // Along an edge of the three cube faces that cover all unsigned directions.
static_assert(kDirectionBins == 3 * kCells * kCells);

}  // namespace

int direction_bin(const Eigen::Vector3d& normal) {
  int axis = 0;
  if (!(normal.cwiseAbs().maxCoeff(&axis) > 0.0)) return 0;
  const auto cell = [&](int other) {
    const double share = 0.5 * (normal((axis + other) % 3) / normal(axis) + 1.0);
    return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1);
  };
  return (axis * kCells + cell(1)) * kCells + cell(2);
}

std::array<double, kDirectionBins> direction_weights(const DirectionCounts& counts,
                                                     double exponent) {
  std::array<double, kDirectionBins> weights{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) weights[i] = std::pow(counts[i], -exponent);
  }
  return weights;
}

SurfaceKey surface_key(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double cube_m) {
  const Eigen::Array3d cube =
      (point.array() / cube_m).floor().max(-LeafGrid::kMaxIndex).min(LeafGrid::kMaxIndex);
  return {leaf_key(cube.matrix().cast<int>()), direction_bin(normal)};
}

}  // namespace croon
