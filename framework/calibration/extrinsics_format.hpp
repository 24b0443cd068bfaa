#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/calibration/frame_links.hpp"

namespace croon {

/// A file that may contain extrinsics.
struct ExtrinsicsSource {
  std::filesystem::path path;
  std::string text;

  std::string file() const { return path.string(); }
};

/// An extrinsics format: one row of the table in extrinsics.cpp.
struct ExtrinsicsFormat {
  const char* name;
  /// Formats the poses as files; null for a format that can only be read.
  std::vector<ExtrinsicsFile> (*write)(const Extrinsics& extrinsics);
  /// Whether the content of a file looks like this format.
  bool (*recognises)(const std::string& text);
  /// Throws InputError at the first fault.
  std::vector<FrameLink> (*read)(const ExtrinsicsSource& source);
  /// Whether rejected poses are always written, marked with their verdict.
  bool has_verdicts = false;
};

// The functions of the rows, by file: ROS (extrinsics_ros.cpp), YAML (extrinsics_yaml.cpp), plain
// text (extrinsics_plain.cpp), JSON (extrinsics_json.cpp).
ExtrinsicsFormat ros2_format();
ExtrinsicsFormat ros2_yaml_format();
ExtrinsicsFormat urdf_format();
ExtrinsicsFormat autoware_format();
ExtrinsicsFormat apollo_format();
ExtrinsicsFormat kitti_format();
ExtrinsicsFormat nuscenes_format();
ExtrinsicsFormat kalibr_format();
ExtrinsicsFormat opencalib_format();
ExtrinsicsFormat matrix_format();
ExtrinsicsFormat csv_format();
ExtrinsicsFormat croon_extrinsics_format();
ExtrinsicsFormat nominal_format();

/// A position in a file, for errors.
struct FilePlace {
  std::string file;
  std::string where;

  /// Throws InputError with `message` at this position.
  [[noreturn]] void refuse(const std::string& message) const;
};

/// `value` in a form that every reader parses as a floating-point number: no exponent below 1e9,
/// always a decimal point; bitwise the same when it is read.
std::string decimal_number(double value);

/// `values` as decimal numbers, joined by `separator`.
std::string decimal_numbers(const std::vector<double>& values, const std::string& separator);

/// `text` in double quotes, with quotes and backslashes escaped: a string in YAML, JSON or Python.
std::string in_escaped_quotes(const std::string& text);

/// Converts a verdict to "accepted" or "rejected" and back; throws InputError for any other word.
const char* verdict_word(bool is_accepted);
bool is_accepted_word(const std::string& word, const FilePlace& place);

/// A comment for a pose: "accepted", or a warning that it was rejected and is only a best guess, or
/// that the clouds contradict it.
std::string verdict_comment(const ExtrinsicPose& pose);

/// Converts a name for a format, such as "/top/points" to "top/points".
using NameRule = std::function<std::string(const std::string&)>;

/// The extrinsics with `rule` applied to the names of all frames. Distinct names stay distinct,
/// even without regard to case: one of them gets the suffix "_2".
Extrinsics renamed(const Extrinsics& extrinsics, const NameRule& rule);

/// Name rules: printable text; a ROS frame, without a leading slash; a file name without suffix, of
/// letters, digits, `_`, `-` and `.`.
std::string printable_name(const std::string& name);
std::string ros_frame_name(const std::string& name);
std::string file_stem(const std::string& name);

/// The rotation of a quaternion in the order x, y, z, w, which must have unit length within 1e-3.
Eigen::Matrix3d checked_quaternion(const Eigen::Vector4d& xyzw, const FilePlace& place);
/// The nearest rotation to a matrix that is a rotation within 1e-3.
Eigen::Matrix3d checked_matrix(const Eigen::Matrix3d& matrix, const FilePlace& place);
/// `rotation_from_rpy`, but throws for angles beyond a full turn, which are probably degrees.
Eigen::Matrix3d checked_radians(const Eigen::Vector3d& rpy_rad, const FilePlace& place);
/// The position, whose coordinates must be finite and at most kMaxCoordinate_m.
Eigen::Vector3d checked_position(const Eigen::Vector3d& position_m, const FilePlace& place);
/// The pose from three or four rows of four numbers, in row-major order.
RigidTransform checked_pose(const std::vector<double>& rows, const FilePlace& place);

/// The numbers in `text`, separated by blanks or commas; there must be `count` of them unless it is
/// 0.
std::vector<double> numbers_in(std::string_view text, std::size_t count, const FilePlace& place);

/// The matrix of the pose as three or four rows of four numbers, in row-major order.
std::vector<double> rows_of(const RigidTransform& T, int rows);

}  // namespace croon
