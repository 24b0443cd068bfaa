// The YAML formats: read with yaml-cpp, but written without it, because readers disagree about
// numbers such as 1e-05.
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/extrinsics_format.hpp"
#include "framework/geometry/exact_rpy.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// A value of a YAML file, with its position for errors.
class YamlValue {
 public:
  YamlValue(const YAML::Node& node, std::string file, std::string key = "")
      : node_(node), file_(std::move(file)), key_(std::move(key)) {}

  FilePlace place() const {
    const YAML::Mark mark = node_.Mark();
    return {file_, mark.is_null() ? "" : "line " + std::to_string(mark.line + 1)};
  }
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool has(const std::string& key) const { return is_map() && node_[key].IsDefined(); }

  /// The members of a map, or the elements of a list.
  std::vector<YamlValue> members() const {
    std::vector<YamlValue> members;
    if (is_list()) {
      for (const YAML::Node& element : node_) members.emplace_back(element, file_);
    }
    if (!is_map()) return members;
    for (const auto& entry : node_) {
      if (!entry.first.IsScalar()) place().refuse("expected a name as key, found a list or map");
      members.emplace_back(entry.second, file_, entry.first.Scalar());
    }
    return members;
  }
  const std::string& key() const { return key_; }

  YamlValue member(const std::string& key) const {
    if (has(key)) return {node_[key], file_, key};
    std::vector<std::string> keys;
    for (const YamlValue& other : members()) keys.push_back(other.key());
    place().refuse("expected the key " + in_quotes(key) + ", found none" + name_hint(key, keys));
  }

  std::string text() const {
    if (!node_.IsScalar()) place().refuse("expected a name, found none");
    return node_.Scalar();
  }

  double number() const {
    return numbers_in(node_.IsScalar() ? node_.Scalar() : "", 1, place())[0];
  }

  /// The numbers of a list, including nested lists.
  std::vector<double> numbers() const {
    if (!is_list()) return {number()};
    std::vector<double> all;
    for (const YamlValue& element : members()) {
      for (const double number : element.numbers()) all.push_back(number);
    }
    return all;
  }

 private:
  YAML::Node node_;
  std::string file_, key_;
};

YamlValue yaml_of(const ExtrinsicsSource& source) {
  try {
    const YamlValue root(YAML::Load(source.text), source.file());
    if (!root.is_map() && !root.is_list()) root.place().refuse("expected a YAML map");
    return root;
  } catch (const YAML::Exception& error) {
    throw InputError(source.file(),
                     error.mark.is_null() ? "" : "line " + std::to_string(error.mark.line + 1),
                     "expected YAML, found: " + error.msg);
  }
}

/// The members `keys` of a map as numbers.
Eigen::VectorXd numbers_by_key(const YamlValue& map, const std::vector<std::string>& keys) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(keys.size()));
  for (std::size_t i = 0; i < keys.size(); ++i) {
    numbers(static_cast<Eigen::Index>(i)) = map.member(keys[i]).number();
  }
  return numbers;
}

/// A translation and a quaternion, each a map with x, y, z, w.
RigidTransform stamped_pose(const YamlValue& value) {
  const YamlValue rotation = value.member("rotation");
  const YamlValue translation = value.member("translation");
  return {checked_quaternion(numbers_by_key(rotation, {"x", "y", "z", "w"}), rotation.place()),
          checked_position(numbers_by_key(translation, {"x", "y", "z"}), translation.place())};
}

/// The lines of a translation and a quaternion.
std::string stamped_pose_lines(const RigidTransform& T, const std::string& indent) {
  const Eigen::Vector4d q = unit_quaternion(T.rotation).coeffs();
  return indent + "translation: {x: " + decimal_number(T.translation.x()) +
         ", y: " + decimal_number(T.translation.y()) + ", z: " + decimal_number(T.translation.z()) +
         "}\n" + indent + "rotation: {x: " + decimal_number(q(0)) + ", y: " + decimal_number(q(1)) +
         ", z: " + decimal_number(q(2)) + ", w: " + decimal_number(q(3)) + "}\n";
}

/// geometry_msgs/TransformStamped: the frames and the pose, which may be nested in a map
/// "transform".
FrameLink stamped_link(const YamlValue& value) {
  FrameLink link;
  const YamlValue header = value.has("header") ? value.member("header") : value;
  link.parent = header.member("frame_id").text();
  link.child = value.member("child_frame_id").text();
  link.where = value.place().where;
  link.T_parent_child = stamped_pose(value.has("transform") ? value.member("transform") : value);
  if (value.has("verdict")) {
    const YamlValue verdict = value.member("verdict");
    link.is_accepted = is_accepted_word(verdict.text(), verdict.place());
  }
  return link;
}

std::vector<ExtrinsicsFile> write_ros2_yaml(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, ros_frame_name);
  std::string text =
      "# As geometry_msgs/TransformStamped: each maps child_frame_id to frame_id. Metres.\n"
      "transforms:\n";
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    text += "  - frame_id: " + in_escaped_quotes(extrinsics.parent) +
            "\n    child_frame_id: " + in_escaped_quotes(pose.sensor) +
            "\n    verdict: " + verdict_word(pose.is_accepted) + "\n" +
            stamped_pose_lines(pose.T_parent_sensor, "    ");
  }
  return {{"extrinsics.yaml", text}};
}

std::vector<FrameLink> read_ros2_yaml(const ExtrinsicsSource& source) {
  std::vector<FrameLink> links;
  const YamlValue transforms = yaml_of(source).member("transforms");
  for (const YamlValue& value : transforms.members()) links.push_back(stamped_link(value));
  return links;
}

std::vector<ExtrinsicsFile> write_apollo(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, printable_name);
  const Extrinsics stems = renamed(original, file_stem);
  std::vector<ExtrinsicsFile> files;
  for (std::size_t i = 0; i < extrinsics.poses.size(); ++i) {
    const ExtrinsicPose& pose = extrinsics.poses[i];
    files.push_back({stems.poses[i].sensor + "_extrinsics.yaml",
                     "# " + verdict_comment(pose) +
                         "\n# The pose of child_frame_id in header.frame_id. Metres.\n"
                         "header:\n  stamp:\n    secs: 0\n    nsecs: 0\n  seq: 0\n  frame_id: " +
                         in_escaped_quotes(extrinsics.parent) + "\ntransform:\n" +
                         stamped_pose_lines(pose.T_parent_sensor, "  ") +
                         "child_frame_id: " + in_escaped_quotes(pose.sensor) + "\n"});
  }
  return files;
}

std::vector<FrameLink> read_apollo(const ExtrinsicsSource& source) {
  return {stamped_link(yaml_of(source))};
}

const std::vector<std::string>& autoware_keys() {
  static const std::vector<std::string> keys = {"x", "y", "z", "roll", "pitch", "yaw"};
  return keys;
}

std::vector<ExtrinsicsFile> write_autoware(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, ros_frame_name);
  std::string text =
      "# The pose of each frame in its parent frame. Metres and radians, R = Rz(yaw) Ry(pitch)\n# "
      "Rx(roll).\n" +
      in_escaped_quotes(extrinsics.parent) + (extrinsics.poses.empty() ? ": {}\n" : ":\n");
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    Vector6d values;
    values << pose.T_parent_sensor.translation, exact_rpy(pose.T_parent_sensor.rotation);
    text += "  " + in_escaped_quotes(pose.sensor) + ":  # " + verdict_comment(pose) + "\n";
    for (std::size_t i = 0; i < 6; ++i) {
      text += "    " + autoware_keys()[i] + ": " +
              decimal_number(values(static_cast<Eigen::Index>(i))) + "\n";
    }
  }
  return {{"sensor_kit_calibration.yaml", text}};
}

std::vector<FrameLink> read_autoware(const ExtrinsicsSource& source) {
  std::vector<FrameLink> links;
  for (const YamlValue& parent : yaml_of(source).members()) {
    for (const YamlValue& child : parent.members()) {
      const FilePlace place = child.place();
      const Vector6d values = numbers_by_key(child, autoware_keys());
      const RigidTransform T = {checked_radians(values.tail<3>(), place),
                                checked_position(values.head<3>(), place)};
      links.push_back({parent.key(), child.key(), T, place.where});
    }
  }
  return links;
}

std::vector<ExtrinsicsFile> write_kalibr(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, printable_name);
  std::string text =
      "# As T_cam_imu of Kalibr: each matrix maps points of the parent to the sensor. Metres.\n";
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    text += in_escaped_quotes(pose.sensor) + ":\n  T_sensor_parent:\n";
    const std::vector<double> numbers = rows_of(pose.T_parent_sensor.inverse(), 4);
    for (auto row = numbers.begin(); row != numbers.end(); row += 4) {
      text += "  - [" + decimal_numbers({row, row + 4}, ", ") + "]\n";
    }
    text += "  parent: " + in_escaped_quotes(extrinsics.parent) +
            "\n  verdict: " + verdict_word(pose.is_accepted) + "\n";
  }
  return {{"extrinsics_camchain.yaml", text}};
}

/// A key of a matrix in a camera chain, with the default parent and whether the matrix maps the
/// parent to the sensor.
struct ChainKey {
  const char* name;
  const char* parent;
  bool maps_to_sensor;
};
constexpr std::array<ChainKey, 4> kChainKeys = {{{"T_sensor_parent", "", true},
                                                 {"T_parent_sensor", "", false},
                                                 {"T_cam_imu", "imu", true},
                                                 {"T_imu_cam", "imu", false}}};

/// `previous` is the preceding sensor, to which T_cn_cnm1 of Kalibr refers.
FrameLink chain_link(const YamlValue& sensor, const std::string& previous) {
  FrameLink link;
  link.child = sensor.key();
  link.where = sensor.place().where;
  const auto read = [&](const std::string& key, const std::string& parent, bool maps_to_sensor) {
    const YamlValue matrix = sensor.member(key);
    const RigidTransform T = checked_pose(matrix.numbers(), matrix.place());
    link.T_parent_child = maps_to_sensor ? T.inverse() : T;
    link.parent = sensor.has("parent") ? sensor.member("parent").text() : parent;
  };
  if (sensor.has("verdict")) {
    const YamlValue verdict = sensor.member("verdict");
    link.is_accepted = is_accepted_word(verdict.text(), verdict.place());
  }
  // If a camera also has T_cn_cnm1, the link to the inertial sensor already relates it to the first
  // one.
  for (const ChainKey& key : kChainKeys) {
    if (!sensor.has(key.name)) continue;
    read(key.name, key.parent, key.maps_to_sensor);
    return link;
  }
  if (!previous.empty()) {
    read("T_cn_cnm1", previous, true);
    return link;
  }
  sensor.member(kChainKeys.front().name);  // Throws.
  return link;
}

std::vector<FrameLink> read_kalibr(const ExtrinsicsSource& source) {
  std::vector<FrameLink> links;
  std::string previous;
  for (const YamlValue& sensor : yaml_of(source).members()) {
    const auto has = [&](const ChainKey& key) { return sensor.has(key.name); };
    const bool is_first_camera =
        previous.empty() && std::none_of(kChainKeys.begin(), kChainKeys.end(), has);
    if (!is_first_camera) links.push_back(chain_link(sensor, previous));
    previous = sensor.key();
  }
  return links;
}

/// Whether one of `keys` occurs in `text` as a word before a colon, and the text is not JSON.
bool has_yaml_key(const std::string& text, const std::vector<std::string>& keys) {
  if (text.front() == '{' || text.front() == '[') return false;
  for (const std::string& key : keys) {
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
      const bool is_begin =
          at == 0 || std::string("\n \t\"'{,-").find(text[at - 1]) != std::string::npos;
      const std::size_t next = text.find_first_not_of(" \t\"'", at + key.size());
      if (is_begin && next != std::string::npos && text[next] == ':') return true;
    }
  }
  return false;
}

}  // namespace

ExtrinsicsFormat ros2_yaml_format() {
  return {"ros2-yaml", write_ros2_yaml,
          [](const std::string& text) { return has_yaml_key(text, {"transforms"}); },
          read_ros2_yaml};
}

ExtrinsicsFormat apollo_format() {
  return {"apollo", write_apollo,
          [](const std::string& text) {
            return has_yaml_key(text, {"child_frame_id"}) && !has_yaml_key(text, {"transforms"});
          },
          read_apollo};
}

ExtrinsicsFormat autoware_format() {
  return {"autoware", write_autoware,
          [](const std::string& text) {
            return has_yaml_key(text, {"roll", "pitch", "yaw"});
          },
          read_autoware};
}

ExtrinsicsFormat kalibr_format() {
  return {"kalibr", write_kalibr,
          [](const std::string& text) {
            return has_yaml_key(text, {"T_sensor_parent", "T_parent_sensor", "T_cam_imu",
                                       "T_imu_cam", "T_cn_cnm1"});
          },
          read_kalibr};
}

}  // namespace croon
