// Clouds as stages see them, and reading and writing of cloud files.
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/interpreter.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon::python {
namespace {

using SharedCloud = std::shared_ptr<Cloud>;

py::array read_cloud(const std::string& path) {
  LoadedCloud cloud;
  {
    const WithoutGil no_gil;
    cloud = read_point_cloud(path);
  }
  return array_of_file(cloud, path);
}

/// Writes .pcd or .ply; croon._clouds has already checked the arguments.
void write_cloud(const std::string& path, const py::object& array, const std::string& suffix,
                 const std::string& encoding) {
  const PointCloud cloud = cloud_or_empty_from(array, "cloud");
  const bool is_ascii = encoding == "ascii";
  const WithoutGil no_gil;
  if (suffix == ".ply") {
    write_ply(path, cloud, is_ascii ? PlyFormat::ascii : PlyFormat::binary_little_endian);
  } else {
    write_pcd(path, cloud,
              is_ascii                          ? PcdEncoding::ascii
              : encoding == "binary_compressed" ? PcdEncoding::binary_compressed
                                                : PcdEncoding::binary);
  }
}

py::dict channels(const py::object& self) {
  py::dict views;
  for (const Channel& channel : py::cast<const Cloud&>(self).with_channels().channels) {
    views[py::str(channel.name)] = channel_view(channel, self);
  }
  return views;
}

/// The indices of the nearest points of `cloud` (-1 if none is within `max_distance_m`), and
/// distances.
py::tuple nearest(const Cloud& cloud, const py::object& queries, double max_distance_m) {
  const Points points = cloud_or_empty_from(queries, "points").points;
  if (!(max_distance_m >= 0.0)) throw InputError("", "max_distance_m", "expected a distance");
  const auto size = static_cast<py::ssize_t>(points.size());
  py::array_t<std::int64_t> indices(size);
  py::array_t<double> distances(size);
  std::int64_t* const index = indices.mutable_data();
  double* const distance = distances.mutable_data();
  {
    const WithoutGil no_gil;
    const KdTree& tree = cloud.kd_tree();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Neighbour found = std::isfinite(max_distance_m)
                                  ? tree.nearest(points[i], static_cast<float>(max_distance_m))
                                  : tree.nearest(points[i]);
      index[i] = found.index;
      distance[i] = found ? std::sqrt(static_cast<double>(found.squared_distance_m2))
                          : std::numeric_limits<double>::infinity();
    }
  }
  return py::make_tuple(indices, distances);
}

/// A unit normal per point, zero if undefined.
py::array normals(const Cloud& cloud, int neighbours) {
  if (neighbours < 3) {
    throw InputError("", "neighbours", "expected at least 3, found " + std::to_string(neighbours));
  }
  py::array_t<float> array({static_cast<py::ssize_t>(cloud.points().size()), py::ssize_t{3}});
  float* to = array.mutable_data();
  const WithoutGil no_gil;
  const Normals& shapes = cloud.normals(neighbours);
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const Eigen::Vector3f normal = shapes.at(static_cast<int>(i)).normal;
    for (int axis = 0; axis < 3; ++axis) *to++ = normal(axis);
  }
  return array;
}

/// Marks that this thread is computing the value `key` of `cloud`, whose recursive use would wait
/// forever. Throws StageError in that case.
class Computing {
 public:
  Computing(const Cloud& cloud, const std::string& key) : mark_(&cloud, key) {
    if (!marks().insert(mark_).second) throw StageError("the value \"" + key + "\" needs itself");
  }
  ~Computing() { marks().erase(mark_); }
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;

 private:
  using Mark = std::pair<const Cloud*, std::string>;
  static std::set<Mark>& marks() {
    thread_local std::set<Mark> marks;
    return marks;
  }
  Mark mark_;
};

/// The result of `make`, which is called only once for this cloud and `key`.
py::object once(const Cloud& cloud, const std::string& key, const py::object& make) {
  const Computing computing(cloud, key);
  std::shared_ptr<const ObjectRef> value;
  const ObjectRef function(make);
  {
    const WithoutGil no_gil;
    value = cloud.once<ObjectRef>("python/" + key, [&] {
      return in_python([&] { return std::make_shared<const ObjectRef>(function.get()()); });
    });
  }
  return value->get();
}

}  // namespace

void bind_clouds(py::module_& module) {
  py::class_<Cloud, SharedCloud>(module, "Cloud",
                                 "The cloud of one sensor as a stage sees it, in the sensor's "
                                 "frame, metres. Immutable.")
      .def("__len__", [](const Cloud& cloud) { return cloud.points().size(); })
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            return points_view(py::cast<const Cloud&>(self).points(), self);
          },
          "The points, N×3, float32; a read-only view.")
      .def_property_readonly("channels", channels,
                             "The channels by name, N or N×count each; read-only views.")
      .def(
          "to_array", [](const Cloud& cloud) { return structured_array(cloud.with_channels()); },
          "A structured array with x, y, z and the channels; a copy.")
      .def("nearest", nearest, py::arg("points"),
           py::arg("max_distance_m") = std::numeric_limits<double>::infinity(),
           "For each of points (N×3) the index of the nearest point of this cloud within\n"
           "max_distance_m (-1 if there is none) and its distance in metres: (indices, distances).")
      .def("normals", normals, py::arg("neighbours"),
           "A unit normal per point, N×3, towards the sensor, from this number of nearest\n"
           "neighbours; zero where undefined. Computed once per cloud.")
      .def(
          "once", once, py::arg("name"), py::arg("make"),
          "The result of make(), computed at the first call for this cloud and name and shared by\n"
          "all trials, variants and threads. The name must identify everything that the value\n"
          "depends on besides the cloud.");
  module.def("read_cloud", read_cloud);
  module.def("write_cloud", write_cloud);
}

}  // namespace croon::python
