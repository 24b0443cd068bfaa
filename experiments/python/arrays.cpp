#include "experiments/python/arrays.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "experiments/python/interpreter.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::python {
namespace {

constexpr int kToNative = py::array::c_style | py::array::forcecast;

[[noreturn]] void refuse(const std::string& what, const std::string& expected,
                         const std::string& found) {
  throw InputError("", what, "expected " + expected + ", found " + found);
}

constexpr const char* kCloudWords =
    "an N×3 array of float32 or float64, or a structured array with x, y and z";

/// "an array of shape (3, 4) and type int64".
std::string array_words(const py::array& array) {
  const std::string shape = text_of(array.attr("shape"));
  const std::string type = text_of(array.dtype());
  return "an array of shape " + shape + " and type " + type;
}

/// A masked array marks some of its numbers as invalid; converting it to an array loses the mask.
bool is_masked_array(const py::object& object) {
  return py::isinstance(object, py::module_::import("numpy").attr("ma").attr("MaskedArray"));
}

py::array any_array(const py::object& object, const std::string& what, const std::string& words) {
  const bool is_text = py::isinstance<py::str>(object) || py::isinstance<py::bytes>(object);
  if (object.is_none() || is_text || is_masked_array(object)) {
    refuse(what, words, type_words(object));
  }
  const py::array array = py::array::ensure(object);
  if (!array || array.dtype().kind() == 'O') refuse(what, words, type_words(object));
  return array;
}

/// Converts to an array of double with the shape rows×columns or rows.
py::array_t<double> numbers(const py::object& object, const std::string& what,
                            const std::string& words, const std::vector<py::ssize_t>& shape) {
  const py::array array = any_array(object, what, words);
  const bool is_number = std::string("fiu").find(array.dtype().kind()) != std::string::npos;
  const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
  if (!is_number || found != shape) refuse(what, words, array_words(array));
  const py::array_t<double, kToNative> values(array);
  const double* const data = values.data();
  if (!std::all_of(data, data + values.size(), [](double x) { return std::isfinite(x); })) {
    refuse(what, words, "numbers that are not finite");
  }
  return values;
}

void copy_points(const py::array& array, Points& points) {
  points.resize(static_cast<std::size_t>(array.shape(0)));
  if (py::isinstance<py::array_t<float>>(array)) {
    const py::array_t<float, kToNative> values(array);  // No copy if it is contiguous.
    std::memcpy(static_cast<void*>(points.data()), values.data(), values.nbytes());
    return;
  }
  const py::array_t<double, kToNative> values(array);
  const double* from = values.data();
  for (Eigen::Vector3f& point : points) {
    for (int axis = 0; axis < 3; ++axis) point(axis) = static_cast<float>(*from++);
  }
}

/// The field `name` as contiguous little-endian numbers.
py::array contiguous_field(const py::array& array, const std::string& name) {
  const py::object numpy = py::module_::import("numpy");
  const py::object field = array[py::str(name)];
  const py::object type = field.attr("dtype").attr("newbyteorder")("<");
  return numpy.attr("ascontiguousarray")(field, type);
}

/// The type of a field's numbers; throws InputError for text and objects.
ScalarType scalar_type_from(const py::dtype& type, const std::string& what,
                            const std::string& field) {
  const char kind = type.kind();
  const auto size = static_cast<std::size_t>(type.itemsize());
  const bool is_float = kind == 'f' && (size == 4 || size == 8);
  if (!is_float && kind != 'i' && kind != 'u') {
    throw InputError("", what,
                     "expected numbers in the field \"" + field + "\", found " + text_of(type));
  }
  return {kind == 'f'   ? ScalarKind::floating
          : kind == 'i' ? ScalarKind::signed_integer
                        : ScalarKind::unsigned_integer,
          size};
}

void copy_coordinate(const py::array& array, const std::string& name, int axis,
                     const std::string& what, Points& points) {
  const py::array values = contiguous_field(array, name);
  const ScalarType type = scalar_type_from(values.dtype(), what, name);
  if (values.ndim() != 1) refuse(what, "one number per point in \"" + name + "\"", "several");
  const auto* bytes = static_cast<const char*>(values.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i](axis) =
        static_cast<float>(decode_scalar(type, ByteOrder::little, bytes + i * type.size));
  }
}

PointCloud structured_cloud(const py::array& array, const std::string& what) {
  if (array.ndim() != 1) refuse(what, kCloudWords, array_words(array));
  PointCloud cloud;
  cloud.points.resize(static_cast<std::size_t>(array.shape(0)));
  int coordinates = 0;
  for (const py::handle item : array.dtype().attr("names")) {
    const std::string name = text_of(item);
    const bool is_coordinate = name == "x" || name == "y" || name == "z";
    if (is_coordinate) {
      ++coordinates;
      copy_coordinate(array, name, name.front() - 'x', what, cloud.points);
      continue;
    }
    const py::array values = contiguous_field(array, name);
    const ScalarType type = scalar_type_from(values.dtype(), what, name);
    // For an array without points, the count is irrelevant.
    const py::ssize_t count = cloud.empty() ? 1 : values.size() / array.shape(0);
    if (count == 0) refuse(what, "numbers in the field \"" + name + "\"", "none");
    cloud.channels.push_back({name, type, static_cast<std::size_t>(count),
                              std::string(static_cast<const char*>(values.data()),
                                          static_cast<std::size_t>(values.nbytes()))});
  }
  if (coordinates != 3) refuse(what, kCloudWords, array_words(array));
  return cloud;
}

void refuse_points_that_are_not_finite(const Points& points, const std::string& what) {
  const auto count = std::count_if(points.begin(), points.end(),
                                   [](const Eigen::Vector3f& p) { return !p.allFinite(); });
  if (count > 0) {
    throw InputError("", what,
                     "expected finite points, found " + std::to_string(count) + " of " +
                         std::to_string(points.size()) + " that are not");
  }
}

std::string type_code(const ScalarType& type) {
  const char kind = type.kind == ScalarKind::floating         ? 'f'
                    : type.kind == ScalarKind::signed_integer ? 'i'
                                                              : 'u';
  return std::string("<") + kind + std::to_string(type.size);
}

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <int rows, int columns>
py::array_t<double> matrix_array(const Eigen::Matrix<double, rows, columns>& matrix) {
  py::array_t<double> array({rows, columns});
  auto view = array.mutable_unchecked<2>();
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) view(i, j) = matrix(i, j);
  }
  return array;
}

/// Converts an array to a cloud, without checking that the points are finite.
PointCloud unchecked_cloud(const py::object& object, const std::string& what) {
  const py::array array = any_array(object, what, kCloudWords);
  PointCloud cloud;
  if (!array.dtype().attr("names").is_none()) {
    cloud = structured_cloud(array, what);
  } else {
    const py::dtype type = array.dtype();
    const bool is_float = type.kind() == 'f' && (type.itemsize() == 4 || type.itemsize() == 8);
    if (!is_float || array.ndim() != 2 || array.shape(1) != 3) {
      refuse(what, kCloudWords, array_words(array));
    }
    copy_points(array, cloud.points);
  }
  return cloud;
}

}  // namespace

PointCloud cloud_or_empty_from(const py::object& object, const std::string& what) {
  PointCloud cloud = unchecked_cloud(object, what);
  refuse_points_that_are_not_finite(cloud.points, what);
  return cloud;
}

LoadedCloud recorded_cloud_from(const py::object& object, const std::string& what) {
  PointCloud cloud = unchecked_cloud(object, what);
  LoadedCloud recorded;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (recorded.add(cloud.points[i].cast<double>())) kept.push_back(i);
  }
  std::vector<std::string> fields;
  for (const Channel& channel : cloud.channels) fields.push_back(channel.name);
  const std::vector<std::string> names = channel_names(fields);
  recorded.channels = selected(cloud, kept).channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) recorded.channels[i].name = names[i];
  }
  return recorded;
}

PointCloud cloud_from(const py::object& array, const std::string& what) {
  PointCloud cloud = cloud_or_empty_from(array, what);
  if (cloud.empty()) throw InputError("", what, "expected points, found none");
  return cloud;
}

py::array structured_array(const PointCloud& cloud) {
  py::list fields;
  for (const char* const name : {"x", "y", "z"}) fields.append(py::make_tuple(name, "<f4"));
  for (const Channel& channel : cloud.channels) {
    const std::string code = type_code(channel.type);
    fields.append(channel.count == 1
                      ? py::make_tuple(channel.name, code)
                      : py::make_tuple(channel.name, code, py::make_tuple(channel.count)));
  }
  const py::dtype type = py::dtype::from_args(fields);
  py::array array(type, std::vector<py::ssize_t>{static_cast<py::ssize_t>(cloud.size())});
  auto* to = static_cast<char*>(array.mutable_data());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::memcpy(to, cloud.points[i].data(), sizeof(Eigen::Vector3f));
    to += sizeof(Eigen::Vector3f);
    for (const Channel& channel : cloud.channels) {
      const std::size_t size = channel.bytes_per_point();
      std::memcpy(to, channel.bytes.data() + i * size, size);
      to += size;
    }
  }
  return array;
}

py::array array_of_file(const PointCloud& cloud, const std::string& file) {
  for (const Channel& channel : cloud.channels) {
    const std::string name = valid_utf8(channel.name);
    if (name == channel.name) continue;
    throw InputError(file, "", "expected names of fields in UTF-8, found " + in_quotes(name));
  }
  return structured_array(cloud);
}

py::array points_view(const Points& points, const py::object& owner) {
  constexpr py::ssize_t kPoint = sizeof(Eigen::Vector3f);
  constexpr py::ssize_t kNumber = sizeof(float);
  return read_only(py::array(py::dtype::of<float>(),
                             std::vector<py::ssize_t>{static_cast<py::ssize_t>(points.size()), 3},
                             std::vector<py::ssize_t>{kPoint, kNumber}, points.data(), owner));
}

py::array channel_view(const Channel& channel, const py::object& owner) {
  const auto points = static_cast<py::ssize_t>(channel.bytes.size() / channel.bytes_per_point());
  const auto size = static_cast<py::ssize_t>(channel.type.size);
  const auto count = static_cast<py::ssize_t>(channel.count);
  const py::dtype type = py::dtype::from_args(py::str(type_code(channel.type)));
  std::vector<py::ssize_t> shape = {points};
  std::vector<py::ssize_t> strides = {size * count};
  if (count > 1) {
    shape.push_back(count);
    strides.push_back(size);
  }
  return read_only(py::array(type, shape, strides, channel.bytes.data(), owner));
}

RigidTransform pose_from(const py::object& object, const std::string& what) {
  constexpr const char* kWords = "a 4×4 pose: a rotation, a translation and the row 0, 0, 0, 1";
  const py::array_t<double> values = numbers(object, what, kWords, {4, 4});
  const auto view = values.unchecked<2>();
  RigidTransform pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation(i, j) = view(i, j);
    pose.translation(i) = view(i, 3);
  }
  const bool has_last_row =
      view(3, 0) == 0.0 && view(3, 1) == 0.0 && view(3, 2) == 0.0 && view(3, 3) == 1.0;
  if (!has_last_row) refuse(what, kWords, "a different last row");
  if (!is_rotation_matrix(pose.rotation)) {
    refuse(what, kWords, "a matrix whose columns are not orthonormal and right-handed");
  }
  return pose;
}

py::array_t<double> array_from(const RigidTransform& pose) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation;
  matrix.topRightCorner<3, 1>() = pose.translation;
  return matrix_array<4, 4>(matrix);
}

Matrix6d matrix6_from(const py::object& object, const std::string& what) {
  const py::array_t<double> values = numbers(object, what, "a 6×6 matrix of numbers", {6, 6});
  const auto view = values.unchecked<2>();
  Matrix6d matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = view(i, j);
  }
  return matrix;
}

py::array_t<double> array_from(const Matrix6d& matrix) { return matrix_array<6, 6>(matrix); }

py::object object_from(const std::optional<Matrix6d>& matrix) {
  return matrix ? py::object(array_from(*matrix)) : py::none();
}

Eigen::Vector3d vector_from(const py::object& object, const std::string& what) {
  const py::array_t<double> values = numbers(object, what, "three numbers", {3});
  return {values.at(0), values.at(1), values.at(2)};
}

py::array_t<double> array_from(const Eigen::Vector3d& vector) {
  py::array_t<double> array(3);
  std::copy(vector.data(), vector.data() + 3, array.mutable_data());
  return array;
}

}  // namespace croon::python
