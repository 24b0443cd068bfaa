#pragma once

#include <Eigen/Core>
#include <vector>

namespace croon {

/// Points in the frame of the sensor that took them, in metres, all finite. Float, as a sensor
/// delivers them; poses and sums are double.
using PointCloud = std::vector<Eigen::Vector3f>;

}  // namespace croon
