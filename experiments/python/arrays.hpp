#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon::python {

namespace py = pybind11;

// NumPy arrays and croon's types. `what` names the array in errors: "target". All of these need the
// interpreter's lock.

/// The cloud in `array`: N×3 numbers (float32 or float64), or a structured array with the fields x,
/// y and z, whose other fields become channels. The points are copied once. Throws InputError for
/// anything else, for no points, and for points that are not finite.
PointCloud cloud_from(const py::object& array, const std::string& what);

/// The same, but the cloud may have no points.
PointCloud cloud_or_empty_from(const py::object& array, const std::string& what);

/// A cloud as a reader of files returns it: points that are not finite or exactly zero are dropped
/// and counted, and a field that drivers call "t" or "timestamp" is the channel "time". May have no
/// points. Throws InputError as `cloud_from`.
LoadedCloud recorded_cloud_from(const py::object& array, const std::string& what);

/// A structured array with x, y, z (float32) and the channels; a copy.
py::array structured_array(const PointCloud& cloud);

/// The same of a cloud that was read from `file`. Throws InputError if the name of a channel is not
/// UTF-8.
py::array array_of_file(const PointCloud& cloud, const std::string& file);

/// A read-only N×3 view of `points`, which `owner` keeps alive.
py::array points_view(const Points& points, const py::object& owner);

/// A read-only view of a channel's numbers, which `owner` keeps alive: N, or N×count.
py::array channel_view(const Channel& channel, const py::object& owner);

/// The pose in a 4×4 array. Throws InputError if it is none: not finite, not a rotation.
RigidTransform pose_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const RigidTransform& pose);

/// A 6×6 matrix. Throws InputError for another shape and for numbers that are not finite.
Matrix6d matrix6_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const Matrix6d& matrix);
/// None if there is none.
py::object object_from(const std::optional<Matrix6d>& matrix);

/// Three finite numbers.
Eigen::Vector3d vector_from(const py::object& array, const std::string& what);
py::array_t<double> array_from(const Eigen::Vector3d& vector);

}  // namespace croon::python
