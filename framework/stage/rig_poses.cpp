#include "framework/stage/rig_poses.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
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

RigidTransform read_pose(const params::Node& pose) {
  if (!pose.is_object()) return {};
  pose.refuse_unknown_keys({"rotation_rpy_deg", "translation_m"});
  const Eigen::Vector3d rpy_deg = read_vector(pose, "rotation_rpy_deg");
  return {rotation_from_rpy(rpy_deg * rad_from_deg(1.0)), read_vector(pose, "translation_m")};
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

}  // namespace croon
