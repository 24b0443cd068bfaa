#include "framework/calibration/rig_extrinsics.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/error_budget.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

using RigJson = nlohmann::ordered_json;

RigJson list_of_numbers(const Eigen::VectorXd& numbers) {
  RigJson list = RigJson::array();
  // Adding zero turns a negative zero into a positive one.
  for (const double number : numbers) list.push_back(number + 0.0);
  return list;
}

RigJson matrix_json(const Eigen::MatrixXd& matrix) {
  RigJson rows = RigJson::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(list_of_numbers(matrix.row(i).transpose()));
  }
  return rows;
}

RigJson pose_json(const RigidTransform& T) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = T.rotation;
  matrix.topRightCorner<3, 1>() = T.translation;
  return {
      {"translation_m", list_of_numbers(T.translation)},
      {"quaternion_xyzw", list_of_numbers(unit_quaternion(T.rotation).coeffs())},
      {"roll_pitch_yaw_deg", list_of_numbers(rpy_from_rotation(T.rotation) * deg_from_rad(1.0))},
      {"matrix", matrix_json(matrix)}};
}

RigJson pose_json(const std::optional<RigidTransform>& T) { return T ? pose_json(*T) : RigJson(); }

RigJson standard_deviation_json(const Matrix6d& covariance) {
  const Vector6d deviations = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return {{"roll_pitch_yaw_deg", list_of_numbers(deviations.head<3>() * deg_from_rad(1.0))},
          {"translation_m", list_of_numbers(deviations.tail<3>())}};
}

/// Adds the keys of a covariance and of its error budget, null if there is none.
void add_uncertainty(RigJson& json, const std::optional<PoseCovariance>& covariance,
                     const std::optional<Matrix6d>& error_budget) {
  for (const char* key : {"standard_deviation", "observability", "covariance", "error_budget"}) {
    json[key] = nullptr;
  }
  if (!covariance) return;
  json["standard_deviation"] = standard_deviation_json(covariance->matrix);
  json["observability"] = RigJson::object();
  for (std::size_t i = 0; i < kDofNames.size(); ++i) {
    json["observability"][kDofNames.at(i)] = name_of(covariance->dofs.at(i));
  }
  json["covariance"] = matrix_json(covariance->matrix);
  if (!error_budget) return;
  const Matrix6d statistical = covariance->matrix - *error_budget;
  json["error_budget"] = {{"standard_deviation", standard_deviation_json(*error_budget)},
                          {"statistical_standard_deviation", standard_deviation_json(statistical)},
                          {"covariance", matrix_json(*error_budget)}};
}

RigJson scene_json(const SceneEstimate& scene) {
  RigJson json = {{"scene", scene.scene}};
  json["verdict"] = scene.reason.empty() ? "accepted" : "rejected";
  json["reason"] = scene.reason;
  json["T_reference_sensor"] = pose_json(scene.T_reference_sensor);
  add_uncertainty(json, scene.covariance, scene.error_budget);
  return json;
}

/// The difference between the pose and the nominal pose; null unless both exist.
RigJson from_nominal(const CalibratedSensor& sensor) {
  if (!sensor.nominal || !sensor.T_reference_sensor) return nullptr;
  const PoseError error = pose_error(*sensor.T_reference_sensor, *sensor.nominal);
  return {{"rotation_deg", deg_from_rad(error.rotation_rad)},
          {"translation_m", error.translation_m},
          {"roll_pitch_yaw_deg", list_of_numbers(error.dof.head<3>() * deg_from_rad(1.0))},
          {"xyz_m", list_of_numbers(error.dof.tail<3>())}};
}

/// The fit check; null if there was none.
RigJson fit_json(const std::optional<Refit>& refit) {
  if (!refit) return nullptr;
  return {{"rotation_deg", deg_from_rad(refit->rotation_rad)},
          {"translation_m", refit->translation_m},
          {"surface_shift_m", refit->surface_shift_m},
          {"is_contradicted", is_contradicted(refit)}};
}

RigJson sensor_json(const CalibratedSensor& sensor) {
  RigJson json = {{"sensor", sensor.sensor}};
  json["verdict"] = sensor.is_accepted ? "accepted" : "rejected";
  json["reasons"] = sensor.reasons;
  json["advice"] = sensor.advice;
  json["T_reference_sensor"] = pose_json(sensor.T_reference_sensor);
  add_uncertainty(json, sensor.covariance, sensor.error_budget);
  json["nominal"] = pose_json(sensor.nominal);
  json["from_nominal"] = from_nominal(sensor);
  json["fit"] = fit_json(sensor.refit);
  json["scenes"] = RigJson::array();
  for (const SceneEstimate& scene : sensor.scenes) json["scenes"].push_back(scene_json(scene));
  return json;
}

RigJson ground_json(const std::optional<GroundPose>& ground) {
  if (!ground) return nullptr;
  return {{"roll_deg", deg_from_rad(ground->roll_rad)},
          {"pitch_deg", deg_from_rad(ground->pitch_rad)},
          {"height_m", ground->height_m},
          {"roll_std_deg", deg_from_rad(ground->roll_std_rad)},
          {"pitch_std_deg", deg_from_rad(ground->pitch_std_rad)},
          {"height_std_m", ground->height_std_m}};
}

RigJson heading_json(const std::optional<HeadingOfTravel>& heading) {
  if (!heading) return nullptr;
  return {{"yaw_deg", deg_from_rad(heading->yaw_rad)},
          {"yaw_std_deg", deg_from_rad(heading->yaw_std_rad)},
          {"scenes", heading->scenes}};
}

RigJson motion_json(const SceneMotionEstimate& motion) {
  const Vector6d deviations = motion.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return {{"scene", motion.scene},
          {"angular_degps", list_of_numbers(motion.velocity.angular_radps * deg_from_rad(1.0))},
          {"linear_mps", list_of_numbers(motion.velocity.linear_mps)},
          {"angular_std_degps", list_of_numbers(deviations.head<3>() * deg_from_rad(1.0))},
          {"linear_std_mps", list_of_numbers(deviations.tail<3>())}};
}

}  // namespace

Extrinsics extrinsics_of(const CalibratedRig& rig) {
  Extrinsics extrinsics = {rig.reference, {}};
  for (const CalibratedSensor& sensor : rig.sensors) {
    extrinsics.poses.push_back({sensor.sensor, sensor.T_reference_sensor.value_or(RigidTransform{}),
                                sensor.is_accepted, sensor.covariance,
                                sensor.T_reference_sensor.has_value(), is_doubtful(sensor)});
  }
  return extrinsics;
}

std::string rig_extrinsics_json(const CalibratedRig& rig) {
  RigJson json = {{"format", 1}, {"reference", rig.reference}};
  json["conventions"] = {
      {"T_reference_sensor", "maps points of the sensor to the reference, metres"},
      {"roll_pitch_yaw", "R = Rz(yaw) Ry(pitch) Rx(roll)"},
      {"covariance",
       "of the error (roll, pitch, yaw of T_estimate T_truth^-1, t_estimate - t_truth), rad and m, "
       "in the reference's frame; it includes error_budget"},
      {"error_budget",
       "the part of the covariance that systematic errors of LiDARs cause, assumed to have "
       "standard deviations of " +
           fixed_number(deg_from_rad(kRealBeamErrors.azimuth_rad), 1) + " deg and " +
           fixed_number(1e3 * kRealBeamErrors.range_m, 0) +
           " mm; the statistical rest is computed from the scatter of the data"},
      {"ground", "T_road_reference: rotation Ry(pitch) Rx(roll), translation (0, 0, height)"},
      {"heading", "yaw of the direction of travel in the levelled frame of the reference"},
      {"fit",
       "how far a new registration with the surfaces of all other accepted sensors moves the "
       "sensor; contradicted: do not use the pose unchecked"}};
  json["sensors"] = RigJson::array();
  for (const CalibratedSensor& sensor : rig.sensors) json["sensors"].push_back(sensor_json(sensor));
  json["warnings"] = rig.warnings;
  json["unused"] = rig.unused;
  json["composition"] = rig.composition;
  json["composition_reason"] = rig.composition_reason;
  json["ground"] = ground_json(rig.ground);
  json["heading"] = heading_json(rig.heading);
  json["motion"] = RigJson::array();
  for (const SceneMotionEstimate& motion : rig.motion)
    json["motion"].push_back(motion_json(motion));
  return json_bytes(json);
}

}  // namespace croon
