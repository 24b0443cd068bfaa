#pragma once

#include <memory>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/points_by_cube.hpp"
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

}  // namespace croon
