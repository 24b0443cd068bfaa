#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/simulation/sensor_model.hpp"

namespace croon::simulation {

/// A sensor on a rig. The pose is in the numbers of `truth.json`, so that a written dataset has the
/// same bits.
struct Mounting {
  SensorModel model = sensor_model("pandar64");
  std::vector<double> rotation_rpy_deg = std::vector<double>(3, 0.0);  ///< Roll, pitch, yaw.
  std::vector<double> translation_m = std::vector<double>(3, 0.0);
  double time_offset_s = 0.0;  ///< How much later than the reference's its sweep begins.

  RigidTransform T_reference_sensor() const;
};

/// The car's body, whose middle is the origin of the car's frame. Sensors see it.
struct CarBody {
  double length_m = 4.75;
  double width_m = 1.9;
  double height_m = 1.48;
  bool is_visible = true;
};

/// A car with its sensors. The reference is level, over the car's axis.
struct Rig {
  CarBody body;
  std::string reference = "top";
  double reference_height_m = 2.1;                        ///< Above the road.
  double reference_forward_m = 0.0;                       ///< Ahead of the body's middle.
  std::vector<std::pair<std::string, Mounting>> sensors;  ///< The reference among them, by name.

  /// The pose of the reference on the car.
  RigidTransform T_car_reference() const;
};

/// The rigs that have names: `croon_five`, that of the paper's simulation, and `croon_three`, that
/// of its real car.
const std::vector<std::pair<std::string, Rig>>& rigs();

}  // namespace croon::simulation
