#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/calibration/frame_links.hpp"

namespace croon {

/// A file that may have extrinsics.
struct ExtrinsicsSource {
  std::filesystem::path path;
  std::string text;

  std::string file() const { return path.string(); }
};

/// A format of extrinsics: one row of the table in extrinsics.cpp.
struct ExtrinsicsFormat {
  const char* name;
  /// The files of the poses; null for a format that is only read.
  std::vector<ExtrinsicsFile> (*write)(const Extrinsics& extrinsics);
  /// Whether the content of a file looks like this format.
  bool (*recognises)(const std::string& text);
  /// Throws InputError at the first fault.
  std::vector<FrameLink> (*read)(const ExtrinsicsSource& source);
  /// Whether rejected poses are always written, with their verdict.
  bool has_verdicts = false;
};

// The rows' functions by file: ROS (extrinsics_ros.cpp), YAML (extrinsics_yaml.cpp), plain text
// (extrinsics_plain.cpp), JSON (extrinsics_json.cpp).
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

  /// Throws InputError with `message` there.
  [[noreturn]] void refuse(const std::string& message) const;
};

/// `value` so that every reader takes it for a floating point number: no exponent below 1e9, always
/// a point; the same bits when it is read.
std::string decimal_number(double value);

/// `values` as decimal numbers with `separator` between them.
std::string decimal_numbers(const std::vector<double>& values, const std::string& separator);

/// `text` in double quotes with `\` before quotes and backslashes: a string in YAML, JSON, Python.
std::string in_escaped_quotes(const std::string& text);

/// The word of a verdict, "accepted" or "rejected", and back. Any other word throws InputError.
const char* verdict_word(bool is_accepted);
bool is_accepted_word(const std::string& word, const FilePlace& place);

/// A comment about a pose: "accepted", or that it was rejected and is only a best guess.
std::string verdict_comment(bool is_accepted);

/// What a format makes of a name: "top/points" of "/top/points".
using NameRule = std::function<std::string(const std::string&)>;

/// The extrinsics with the names of all frames by `rule`. Different names stay different, also if
/// only the case of letters differs: one of them ends in "_2".
Extrinsics renamed(const Extrinsics& extrinsics, const NameRule& rule);

/// Name rules: printable text; a frame of ROS, which does not begin with a slash; the name of a
/// file without suffix, of letters, digits, `_`, `-` and `.`.
std::string printable_name(const std::string& name);
std::string ros_frame_name(const std::string& name);
std::string file_stem(const std::string& name);

/// The rotation of a quaternion in the order x, y, z, w, which must have unit length within 1e-3.
Eigen::Matrix3d checked_quaternion(const Eigen::Vector4d& xyzw, const FilePlace& place);
/// The nearest rotation to a matrix that is one within 1e-3.
Eigen::Matrix3d checked_matrix(const Eigen::Matrix3d& matrix, const FilePlace& place);
/// `rotation_from_rpy`; angles beyond a whole turn are refused, because they look like degrees.
Eigen::Matrix3d checked_radians(const Eigen::Vector3d& rpy_rad, const FilePlace& place);
/// A finite position of at most kMaxCoordinate_m.
Eigen::Vector3d checked_position(const Eigen::Vector3d& position_m, const FilePlace& place);
/// The pose of three or four rows of four numbers, row after row.
RigidTransform checked_pose(const std::vector<double>& rows, const FilePlace& place);

/// The numbers in `text`, between blanks or commas. `count` of them must be there, if it is not 0.
std::vector<double> numbers_in(std::string_view text, std::size_t count, const FilePlace& place);

/// The rotation matrix and translation as rows of four numbers, three or four of them.
std::vector<double> rows_of(const RigidTransform& T, int rows);

}  // namespace croon
