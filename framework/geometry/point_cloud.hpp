#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// Points in the frame of the sensor that measured them, metres, all finite. Float, as sensors
/// deliver them; poses and sums are double.
using Points = std::vector<Eigen::Vector3f>;

/// What a sensor measures besides the coordinates, or a stage adds: `count` numbers per point.
struct Channel {
  std::string name;       ///< "intensity", "ring", "time"; others as their file calls them.
  ScalarType type;        ///< As in the file, so that a cloud is written as it was read.
  std::size_t count = 1;  ///< Numbers per point.
  std::string bytes;      ///< Little-endian, point after point.

  std::size_t bytes_per_point() const { return count * type.size; }
  /// The first number of point `index`.
  double value(std::size_t index) const {
    return decode_scalar(type, ByteOrder::little, bytes.data() + index * bytes_per_point());
  }
};

/// The names of the channels that croon knows: the light that comes back, the index of the laser,
/// and when the ray was fired (see `times_s`).
inline constexpr const char* kIntensity = "intensity";
inline constexpr const char* kRing = "ring";
inline constexpr const char* kTime = "time";
/// Times relative to a packet of the sensor, of which the time of a point cannot be known.
inline constexpr const char* kTimeInPacket = "time_in_packet";
/// How many measured points a point of a thinned cloud is the mean of, at least one; without the
/// channel, of one. plane_patches says what it is good for.
inline constexpr const char* kMeanOf = "mean_of";

/// The points of one scan (one revolution of the LiDAR), and named channels, each as long as the
/// points.
struct PointCloud {
  PointCloud() = default;
  /// Points are a cloud without channels.
  PointCloud(Points points_) : points(std::move(points_)) {}  // NOLINT(google-explicit-constructor)

  Points points;
  std::vector<Channel> channels;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
};

/// A cloud from a file: its measured points in the order of the file, and the number of points that
/// were dropped.
struct LoadedCloud : PointCloud {
  /// Points with a coordinate that is NaN, infinite or too large for a float.
  std::size_t dropped_non_finite = 0;
  /// Points at exactly zero, which drivers write for a ray without a return.
  std::size_t dropped_zero = 0;
  /// Subtracted from every point of the file before it became a float, metres: zero, unless the
  /// coordinates are those of a map.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  std::vector<std::string> notes = {};  ///< What the user should know of the file; sentences.
  std::string sha256 = {};  ///< Of the bytes that the points come from; empty if there is no file.

  /// Appends `point - origin_m` as float if it is a measured point: finite and not at zero. Else
  /// counts it as dropped. Returns whether it was appended.
  bool add(const Eigen::Vector3d& point);
};

/// A channel of `values`, one per point.
template <class Number>
Channel make_channel(const std::string& name, const std::vector<Number>& values) {
  // Memory is little-endian, see docs/design.md.
  return {
      name, scalar_type_of<Number>(), 1,
      std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number))};
}

/// The channel called `name`, or null.
const Channel* find_channel(const PointCloud& cloud, const std::string& name);

/// The first number per point of the channel called `name`. Throws StageError, which names the
/// channels that there are, if the cloud has none of this name.
std::vector<double> channel_values(const PointCloud& cloud, const std::string& name);

/// When each ray was fired, seconds, from the channel `time` in the unit that `unit_of_times`
/// (framework/geometry/time_unit.hpp) finds. Throws StageError if there is no such channel.
std::vector<double> times_s(const PointCloud& cloud);

/// Gives the cloud this channel, in place of one of its name.
void set_channel(PointCloud& cloud, Channel channel);

/// Removes the channels that are not among `names`.
void keep_channels(PointCloud& cloud, const std::set<std::string>& names);

/// The points `indices` of `cloud` with their channels, in this order.
PointCloud selected(const PointCloud& cloud, const std::vector<std::size_t>& indices);

/// The points for which `keep` is true of the index, with their channels, in the order of `cloud`.
template <class Keep>
PointCloud filtered(const PointCloud& cloud, const Keep& keep) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep(i)) indices.push_back(i);
  }
  return selected(cloud, indices);
}

}  // namespace croon
