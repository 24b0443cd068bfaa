#include "framework/simulation/rig.hpp"

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

Mounting mounted(const char* model, std::vector<double> rotation_rpy_deg,
                 std::vector<double> translation_m) {
  return {sensor_model(model), std::move(rotation_rpy_deg), std::move(translation_m), 0.0};
}

/// The CARLA samples' car: the reference 2.1 m above the road, the others at its bumpers and at the
/// edges of its roof, pitched down by 48 degrees. Poses as in the samples.
Rig croon_five() {
  Rig rig;
  rig.body = {4.72, 1.9, 1.45, true};
  rig.reference_height_m = 2.1;
  rig.reference_forward_m = -0.525;
  rig.sensors = {{"back", mounted("carla_pandar_qt", {0, 48, 180}, {-1.8, 0, -0.82})},
                 {"front", mounted("carla_pandar_qt", {0, 48, 0}, {2.9, 0.15, -1.195})},
                 {"left", mounted("carla_pandar_qt", {0, 48, -90}, {0.25, -0.85, -0.595})},
                 {"right", mounted("carla_pandar_qt", {0, 48, 90}, {0.25, 0.85, -0.595})},
                 {"top", mounted("carla_pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

/// The real car of the paper's samples: a roof rack with a Pandar64 and two PandarQTs. Poses are
/// the samples' nominal ones.
Rig croon_three() {
  Rig rig;
  rig.body = {4.7, 1.85, 1.5, true};
  rig.reference_height_m = 2.05;
  rig.reference_forward_m = -0.2;
  rig.sensors = {{"left", mounted("pandar_qt", {-4.2, 45.1, 92.0}, {0.0, 0.56, -0.39})},
                 {"right", mounted("pandar_qt", {-0.5, 45.8, -86.3}, {-0.04, -0.57, -0.41})},
                 {"top", mounted("pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

}  // namespace

RigidTransform Mounting::T_reference_sensor() const {
  const Eigen::Vector3d rpy_deg(rotation_rpy_deg[0], rotation_rpy_deg[1], rotation_rpy_deg[2]);
  return {rotation_from_rpy(rpy_deg * rad_from_deg(1.0)),
          {translation_m[0], translation_m[1], translation_m[2]}};
}

RigidTransform Rig::T_car_reference() const {
  return {Eigen::Matrix3d::Identity(), {reference_forward_m, 0.0, reference_height_m}};
}

const std::vector<std::pair<std::string, Rig>>& rigs() {
  static const std::vector<std::pair<std::string, Rig>> rigs = {{"croon_five", croon_five()},
                                                                {"croon_three", croon_three()}};
  return rigs;
}

}  // namespace croon::simulation
