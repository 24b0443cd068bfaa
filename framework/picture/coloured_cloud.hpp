#pragma once

#include <string>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// One sensor's cloud in its own frame, to be drawn in the reference's.
struct ColouredCloud {
  std::string sensor;
  PointCloud points;
  RigidTransform T_reference_sensor;
};

}  // namespace croon
