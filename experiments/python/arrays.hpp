#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon::python {

namespace py = pybind11;

// Conversions between NumPy arrays and croon's types. `what` names the array in errors: "target".
// All of these require the interpreter's lock.

/// Converts `array` to a cloud: N×3 numbers (float32 or float64), or a structured array with the
/// fields x, y and z, whose other fields become channels. The points are copied once. Throws
/// InputError for anything else, for an empty array, and for points that are not finite.
PointCloud cloud_from(const py::object& array, const std::string& what);

/// The same, but the cloud may be empty.
PointCloud cloud_or_empty_from(const py::object& array, const std::string& what);

/// A cloud like one returned by a file reader: points that are not finite or exactly zero are
/// dropped and counted, and a field that drivers call "t" or "timestamp" becomes the channel
/// "time". May be empty. Throws InputError like `cloud_from`.
LoadedCloud recorded_cloud_from(const py::object& array, const std::string& what);

/// A structured array with x, y, z (float32) and the channels; a copy.
py::array structured_array(const PointCloud& cloud);

/// The same for a cloud read from `file`. Throws InputError if the name of a channel is not UTF-8.
py::array array_of_file(const PointCloud& cloud, const std::string& file);

/// A read-only N×3 view of `points`, which `owner` keeps alive.
py::array points_view(const Points& points, const py::object& owner);

/// A read-only view of a channel's numbers, N or N×count, which `owner` keeps alive.
py::array channel_view(const Channel& channel, const py::object& owner);

/// The pose in a 4×4 array. Throws InputError if it is not finite or not a rigid transform.
RigidTransform pose_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const RigidTransform& pose);

/// A 6×6 matrix. Throws InputError for another shape and for numbers that are not finite.
Matrix6d matrix6_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const Matrix6d& matrix);
/// The matrix as an array; None for std::nullopt.
py::object object_from(const std::optional<Matrix6d>& matrix);

/// A vector of three finite numbers. Throws InputError for anything else.
Eigen::Vector3d vector_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const Eigen::Vector3d& vector);

}  // namespace croon::python
