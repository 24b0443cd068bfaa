#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/simulation/mesh.hpp"
#include "framework/simulation/sensor_model.hpp"

namespace croon::simulation {

/// A sensor on a rig. The pose is stored as the numbers in `truth.json`, so that a written dataset
/// is bitwise the same.
struct Mounting {
  SensorModel model = sensor_model("pandar64");
  std::vector<double> rotation_rpy_deg = {0.0, 0.0, 0.0};  ///< Roll, pitch, yaw.
  std::vector<double> translation_m = {0.0, 0.0, 0.0};
  /// From the start of the reference's scan to the start of this sensor's.
  double time_offset_s = 0.0;

  RigidTransform T_reference_sensor() const;
};

/// What a car looks like from the side: a `truck` is a tractor with a trailer, a `box` has no
/// nose.
enum class HullShape { car, van, truck, box };

/// The body of the car that carries the sensors. Car frame: x forward, y left, z up, origin on the
/// road below the middle of the body.
struct CarBody {
  double length_m = 4.75;
  double width_m = 1.9;
  double height_m = 1.48;
  bool is_visible = true;  ///< Whether the car's own sensors see it.
  HullShape shape = HullShape::car;
};

/// The mesh of `body` in the car's frame: smooth and without mirrors, like that of the paper's
/// samples. Empty if the body is not visible.
Mesh make_own_car(const CarBody& body);

/// A car with its sensors. By default the reference is level and above the middle axis of the car.
struct Rig {
  CarBody body;
  std::string reference = "top";
  double reference_height_m = 2.1;                          ///< Above the road.
  double reference_forward_m = 0.0;                         ///< Ahead of the body's middle.
  double reference_left_m = 0.0;                            ///< To the left of the middle axis.
  std::vector<double> reference_rpy_deg = {0.0, 0.0, 0.0};  ///< Roll, pitch, yaw on the car.
  std::vector<std::pair<std::string, Mounting>> sensors;    ///< By name, with the reference.

  /// The pose of the reference on the car.
  RigidTransform T_car_reference() const;
};

/// The named rigs: `croon_five` of the paper's simulation, `croon_three` of the paper's real car,
/// and rigs whose reference does not overlap with all other sensors.
const std::vector<std::pair<std::string, Rig>>& rigs();

}  // namespace croon::simulation
