#include "framework/stage/rig_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/params/json_file.hpp"
#include "framework/params/node.hpp"

namespace croon {
namespace {

Eigen::Vector3d read_vector(const params::Node& pose, const std::string& key) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  if (!pose.require(key)) return vector;
  const params::Node node = pose.member(key);
  if (!node.value().is_array() || node.value().size() != 3) {
    node.expected("a list of three numbers");
    return vector;
  }
  for (int i = 0; i < 3; ++i) node.element(static_cast<std::size_t>(i)).read(vector(i));
  return vector;
}

RigidTransform pose_of(const Eigen::Vector3d& rpy_deg, const Eigen::Vector3d& translation_m) {
  return {rotation_from_rpy(rpy_deg * rad_from_deg(1.0)), translation_m};
}

/// Notes a fault for each element of the position `translation_m` of `pose` that is too large.
void check_position(const params::Node& pose, const Eigen::Vector3d& translation_m) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(translation_m(i)) <= kMaxCoordinate_m) continue;
    pose.member("translation_m")
        .element(static_cast<std::size_t>(i))
        .expected("a number from -" + fixed_number(kMaxCoordinate_m, 0) + " to " +
                  fixed_number(kMaxCoordinate_m, 0) + " m");
  }
}

RigidTransform read_pose(const params::Node& pose) {
  if (!pose.is_object()) return {};
  pose.refuse_unknown_keys({"rotation_rpy_deg", "translation_m"});
  const Eigen::Vector3d rpy_deg = read_vector(pose, "rotation_rpy_deg");
  const Eigen::Vector3d translation_m = read_vector(pose, "translation_m");
  check_position(pose, translation_m);
  return pose_of(rpy_deg, translation_m);
}

/// Roll, pitch and yaw rounded to billionths of a degree, the precision of a file.
Eigen::Vector3d rounded_rpy_deg(const Eigen::Matrix3d& rotation) {
  constexpr double kPerDegree = 1e9;
  Eigen::Vector3d rpy_deg = rpy_from_rotation(rotation) / rad_from_deg(1.0);
  for (double& angle_deg : rpy_deg) {
    // Adding zero makes a negative zero positive.
    angle_deg = std::round(angle_deg * kPerDegree) / kPerDegree + 0.0;
  }
  return rpy_deg;
}

nlohmann::ordered_json list_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

bool is_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
}

void read_kind(const params::Node& node, std::string& kind) {
  const std::string text = node.value().is_string() ? node.value().get<std::string>() : "";
  // Spreadsheets treat a text that begins with a minus sign as a formula.
  if (!is_word(text) || text.front() == '-') {
    node.expected("a word of letters, digits, \"_\" and \"-\" that does not begin with \"-\"");
    return;
  }
  kind = text;
}

}  // namespace

RigPoses read_rig_poses(const std::filesystem::path& file) {
  const nlohmann::json value = params::read_json_file(file);
  std::vector<Fault> faults;
  const params::Node root(value, file.string(), faults);
  RigPoses poses;
  if (root.is_object()) {
    for (const auto& [sensor, pose] : value.items()) poses[sensor] = read_pose(root.member(sensor));
  }
  if (!faults.empty()) throw InputError(faults);
  return poses;
}

std::string rig_poses_json(const RigPoses& poses) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [sensor, T] : poses) {
    json[sensor] = {{"rotation_rpy_deg", list_of(rounded_rpy_deg(T.rotation))},
                    {"translation_m", list_of(T.translation)}};
  }
  return json.dump(2) + "\n";
}

RigidTransform pose_as_written(const RigidTransform& T_reference_sensor) {
  return pose_of(rounded_rpy_deg(T_reference_sensor.rotation), T_reference_sensor.translation);
}

SceneKinds read_scene_kinds(const std::filesystem::path& file) {
  std::vector<Fault> faults;
  const nlohmann::json value = params::read_json_file(file, faults);
  const params::Node root(value, file.string(), faults);
  SceneKinds kinds;
  if (root.is_object()) {
    for (const auto& [scene, kind] : value.items()) read_kind(root.member(scene), kinds[scene]);
  }
  if (!faults.empty()) throw InputError(faults);
  return kinds;
}

}  // namespace croon
