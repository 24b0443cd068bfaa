#include "framework/calibration/extrinsics_format.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// Maximum deviation of a matrix from a rotation, and of a quaternion from unit length: files have
/// rounded numbers.
constexpr double kFileRounding = 1e-3;

std::string in_small_letters(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// `name`, or the first of `name_2`, `name_3`, ... that is not in `taken`, to which it is added.
std::string untaken(const std::string& name, std::set<std::string>& taken) {
  std::string result = name;
  for (int i = 2; !taken.insert(in_small_letters(result)).second; ++i) {
    result = name + "_" + std::to_string(i);
  }
  return result;
}

}  // namespace

void FilePlace::refuse(const std::string& message) const { throw InputError(file, where, message); }

std::string decimal_number(double value) {
  const std::string text = plain_number(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string decimal_numbers(const std::vector<double>& values, const std::string& separator) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : separator) + decimal_number(value);
  return text;
}

std::string in_escaped_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

const char* verdict_word(bool is_accepted) { return is_accepted ? "accepted" : "rejected"; }

bool is_accepted_word(const std::string& word, const FilePlace& place) {
  if (word == verdict_word(true)) return true;
  if (word == verdict_word(false)) return false;
  place.refuse("expected the verdict \"accepted\" or \"rejected\", found " + in_quotes(word) +
               name_hint(word, {verdict_word(true), verdict_word(false)}));
}

std::string verdict_comment(const ExtrinsicPose& pose) {
  if (!pose.is_accepted) return "REJECTED: only a best guess, do not use it unchecked";
  return pose.is_doubtful ? "accepted, but CONTRADICTED by the clouds: do not use it unchecked"
                          : "accepted";
}

Extrinsics renamed(const Extrinsics& extrinsics, const NameRule& rule) {
  std::vector<std::string> names = {extrinsics.parent};
  for (const ExtrinsicPose& pose : extrinsics.poses) names.push_back(pose.sensor);
  std::set<std::string> taken;
  std::vector<std::string> results(names.size());
  // Names that need no change come first, so that they stay unchanged.
  for (const bool is_kept : {true, false}) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string name = rule(names[i]);
      if (name.empty()) name = "sensor";
      if ((name == names[i]) == is_kept) results[i] = untaken(name, taken);
    }
  }
  Extrinsics result = extrinsics;
  result.parent = results.front();
  for (std::size_t i = 0; i < result.poses.size(); ++i) result.poses[i].sensor = results[i + 1];
  return result;
}

std::string printable_name(const std::string& name) {
  return printable(std::string(trimmed(name)));
}

std::string ros_frame_name(const std::string& name) {
  const std::string text = printable_name(name);
  return text.substr(std::min(text.find_first_not_of('/'), text.size()));
}

std::string file_stem(const std::string& name) {
  const auto is_kept = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.');
  };
  std::string stem = ros_frame_name(name);
  std::replace_if(
      stem.begin(), stem.end(), [&](char c) { return !is_kept(c); }, '_');
  // Neither a hidden file nor a command-line option.
  if (!stem.empty() && (stem.front() == '.' || stem.front() == '-')) stem.front() = '_';
  constexpr std::size_t kMaxStemBytes = 200;
  return stem.substr(0, kMaxStemBytes);
}

Eigen::Matrix3d checked_quaternion(const Eigen::Vector4d& xyzw, const FilePlace& place) {
  const double length = xyzw.norm();
  if (!(std::abs(length - 1.0) <= kFileRounding)) {
    place.refuse("expected a quaternion of unit length, found one of length " +
                 shortest_number(length));
  }
  return Eigen::Quaterniond(xyzw).normalized().toRotationMatrix();
}

Eigen::Matrix3d checked_matrix(const Eigen::Matrix3d& matrix, const FilePlace& place) {
  const double rounding =
      (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!matrix.allFinite() || !(rounding <= kFileRounding)) {
    place.refuse("expected a rotation, found a matrix whose R^T R differs from the identity by " +
                 fixed_number(rounding, 3));
  }
  if (matrix.determinant() < 0.0) {
    place.refuse("expected a rotation, found a reflection: the determinant is -1");
  }
  return nearest_rotation(matrix);
}

Eigen::Matrix3d checked_radians(const Eigen::Vector3d& rpy_rad, const FilePlace& place) {
  for (const double angle : rpy_rad) {
    if (std::abs(angle) <= 2.0 * kPi) continue;
    place.refuse("expected angles in radians, found " + shortest_number(angle) +
                 (std::isfinite(angle) ? ", more than a full turn; is it in degrees?" : ""));
  }
  return rotation_from_rpy(rpy_rad);
}

Eigen::Vector3d checked_position(const Eigen::Vector3d& position_m, const FilePlace& place) {
  for (const double value : position_m) {
    if (std::abs(value) <= kMaxCoordinate_m) continue;
    place.refuse("expected a position of at most " + fixed_number(kMaxCoordinate_m, 0) +
                 " m, found " + shortest_number(value));
  }
  return position_m;
}

RigidTransform checked_pose(const std::vector<double>& rows, const FilePlace& place) {
  if (rows.size() != 12 && rows.size() != 16) {
    place.refuse("expected the 12 or 16 numbers of a 3x4 or 4x4 matrix, found " +
                 std::to_string(rows.size()));
  }
  using Row = Eigen::RowVector4d;
  if (rows.size() == 16 && (Row(rows.data() + 12) - Row(0, 0, 0, 1)).norm() > kFileRounding) {
    place.refuse("expected 0 0 0 1 as the fourth row; is the matrix transposed?");
  }
  Eigen::Matrix<double, 3, 4> matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = Row(rows.data() + 4L * i);
  return {checked_matrix(matrix.leftCols<3>(), place), checked_position(matrix.col(3), place)};
}

std::vector<double> numbers_in(std::string_view text, std::size_t count, const FilePlace& place) {
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::vector<double> numbers;
  for (const std::string_view word : words_of(spaced)) {
    const std::optional<double> number = number_from(word);
    if (!number || !std::isfinite(*number)) {
      place.refuse("expected a number, found " + in_quotes(word) +
                   (word.substr(0, 2) == "${" ? "; expand the file with xacro first" : ""));
    }
    numbers.push_back(*number);
  }
  if (count != 0 && numbers.size() != count) {
    place.refuse("expected " + counted(count, "number") + ", found " +
                 std::to_string(numbers.size()));
  }
  return numbers;
}

std::vector<double> rows_of(const RigidTransform& T, int rows) {
  std::vector<double> numbers;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) numbers.push_back(T.rotation(i, j));
    numbers.push_back(T.translation(i));
  }
  if (rows == 4) numbers.insert(numbers.end(), {0.0, 0.0, 0.0, 1.0});
  return numbers;
}

}  // namespace croon
