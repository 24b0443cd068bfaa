#include "framework/calibration/extrinsics.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/calibration/extrinsics_format.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// One row per format, in the order in which formats are tried when a file is read. All poses map
/// points of the sensor to the parent and all lengths are metres, unless a row says otherwise;
/// roll, pitch and yaw mean R = Rz(yaw) Ry(pitch) Rx(roll), about the fixed axes of the parent.
const std::vector<ExtrinsicsFormat>& formats() {
  static const std::vector<ExtrinsicsFormat> table = {
      // Quaternion x, y, z, w as separate options; older forms can be read.
      ros2_format(),
      // Quaternion x, y, z, w as keys.
      ros2_yaml_format(),
      // Joint origins: xyz, rpy in radians.
      urdf_format(),
      // x, y, z, roll, pitch, yaw in radians, nested under the parent's name.
      autoware_format(),
      // Quaternion x, y, z, w as keys; one file per sensor.
      apollo_format(),
      // Tr_<sensor>_to_<parent>: the first three rows of the matrix, row after row.
      kitti_format(),
      // Quaternion w, x, y, z as a list.
      nuscenes_format(),
      // 4x4 matrices that map points of the parent to the sensor.
      kalibr_format(),
      // Roll, pitch, yaw in degrees, x, y, z by device; device 0 is the parent.
      opencalib_format(),
      // The 4x4 matrix; one file per sensor.
      matrix_format(),
      // Quaternion x, y, z, w; the poses must be in the frame of the reference.
      csv_format(),
      croon_extrinsics_format(),
      nominal_format(),
  };
  return table;
}

const ExtrinsicsFormat& writable_format(const std::string& name) {
  for (const ExtrinsicsFormat& format : formats()) {
    if (format.name == name && format.write != nullptr) return format;
  }
  throw InputError(
      "", "",
      "unknown extrinsics format " + in_quotes(name) + name_hint(name, extrinsics_format_names()));
}

/// The content of `file` without a byte order mark.
std::string content_of(const std::filesystem::path& file) {
  std::string text = read_whole_file(file);
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.erase(0, 3);
  return text;
}

/// Whether `format` recognises `text`, which is passed without leading blanks.
bool recognises(const ExtrinsicsFormat& format, const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && format.recognises(text.substr(begin));
}

/// The observability of each new axis is the worst of the old axes that contribute to it.
DofObservability turned_observability(const DofObservability& observability,
                                      const Eigen::Matrix3d& R_new_parent) {
  constexpr double kMinShare = 0.1;
  DofObservability turned = observability;
  for (const std::size_t block : {0, 3}) {
    for (int i = 0; i < 3; ++i) {
      Observability worst = Observability::determined;
      for (int j = 0; j < 3; ++j) {
        if (std::abs(R_new_parent(i, j)) < kMinShare) continue;
        worst = std::max(worst, observability.at(block + static_cast<std::size_t>(j)));
      }
      turned.at(block + static_cast<std::size_t>(i)) = worst;
    }
  }
  return turned;
}

/// Rotates a covariance to new axes of the parent; the origin does not matter for these errors.
PoseCovariance turned_covariance(const PoseCovariance& covariance,
                                 const Eigen::Matrix3d& R_new_parent) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = R_new_parent;
  turn.bottomRightCorner<3, 3>() = R_new_parent;
  const Matrix6d turned = turn * covariance.matrix * turn.transpose();
  // Bitwise symmetric.
  return {0.5 * (turned + turned.transpose()), turned_observability(covariance.dofs, R_new_parent)};
}

}  // namespace

std::vector<std::string> extrinsics_format_names() {
  std::vector<std::string> names;
  for (const ExtrinsicsFormat& format : formats()) {
    if (format.write != nullptr) names.emplace_back(format.name);
  }
  return names;
}

std::vector<ExtrinsicsFile> write_extrinsics(const Extrinsics& extrinsics,
                                             const std::string& format, bool with_rejected) {
  const ExtrinsicsFormat& row = writable_format(format);
  if (row.has_verdicts) return row.write(extrinsics);
  Extrinsics written = extrinsics;
  const auto is_left_out = [&](const ExtrinsicPose& pose) {
    return !pose.has_pose || (!pose.is_accepted && !with_rejected);
  };
  written.poses.erase(std::remove_if(written.poses.begin(), written.poses.end(), is_left_out),
                      written.poses.end());
  return row.write(written);
}

Extrinsics read_extrinsics(const std::filesystem::path& file) {
  const ExtrinsicsSource source = {file, content_of(file)};
  std::string names;
  for (const ExtrinsicsFormat& format : formats()) {
    if (recognises(format, source.text)) return joined_links(format.read(source), source.file());
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  const std::string start = source.text.substr(0, source.text.find('\n'));
  throw InputError(source.file(), "",
                   "expected extrinsics in one of the formats " + names + ", found a file that " +
                       (source.text.empty() ? "is empty" : "begins with " + in_quotes(start)));
}

Extrinsics in_frame(const Extrinsics& extrinsics, const std::string& new_parent,
                    const RigidTransform& T_new_parent) {
  Extrinsics result = extrinsics;
  result.parent = new_parent;
  for (ExtrinsicPose& pose : result.poses) {
    pose.T_parent_sensor = T_new_parent * pose.T_parent_sensor;
    if (pose.covariance) {
      pose.covariance = turned_covariance(*pose.covariance, T_new_parent.rotation);
    }
  }
  return result;
}

Extrinsics in_frame_of_sensor(const Extrinsics& extrinsics, const std::string& reference,
                              const std::string& file) {
  const auto is_reference = [&](const ExtrinsicPose& pose) { return pose.sensor == reference; };
  const auto found = std::find_if(extrinsics.poses.begin(), extrinsics.poses.end(), is_reference);
  // Several formats do not name the parent: if the file has no pose of the reference, it is the
  // parent.
  if (found == extrinsics.poses.end() &&
      (extrinsics.parent == reference || extrinsics.parent.empty())) {
    Extrinsics result = extrinsics;
    result.parent = reference;
    return result;
  }
  if (found == extrinsics.poses.end()) {
    std::vector<std::string> names = {extrinsics.parent};
    for (const ExtrinsicPose& pose : extrinsics.poses) names.push_back(pose.sensor);
    throw InputError(file, "",
                     "expected the pose of the reference " + in_quotes(reference) + " in " +
                         in_quotes(extrinsics.parent) + ", found none" +
                         name_hint(reference, names));
  }
  Extrinsics others = extrinsics;
  others.poses.erase(others.poses.begin() + (found - extrinsics.poses.begin()));
  return in_frame(others, reference, found->T_parent_sensor.inverse());
}

}  // namespace croon
