#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// Points in the frame of the sensor that measured them, metres, all finite. Float, as delivered by
/// sensors; poses and sums are double.
using Points = std::vector<Eigen::Vector3f>;

/// Per-point data besides the coordinates, measured or added by a stage: `count` numbers per point.
struct Channel {
  std::string name;       ///< "intensity", "ring", "time"; others as named in their file.
  ScalarType type;        ///< As in the file, so that a cloud is written as it was read.
  std::size_t count = 1;  ///< Numbers per point.
  std::string bytes;      ///< Little-endian, point after point.

  std::size_t bytes_per_point() const { return count * type.size; }
  /// The first number of point `index`.
  double value(std::size_t index) const {
    return decode_scalar(type, ByteOrder::little, bytes.data() + index * bytes_per_point());
  }
};

/// The names of the channels that croon knows: the intensity of the return, the index of the laser,
/// and the firing time of the ray (see `times_s`).
inline constexpr const char* kIntensity = "intensity";
inline constexpr const char* kRing = "ring";
inline constexpr const char* kTime = "time";
/// Times relative to a packet of the sensor, from which the time of a point cannot be derived.
inline constexpr const char* kTimeInPacket = "time_in_packet";
/// The number of measured points averaged into a point of a thinned cloud, at least 1; 1 without
/// the channel. Used as a weight by plane_patches.
inline constexpr const char* kMeanOf = "mean_of";

/// The points of one scan (one revolution of the LiDAR), and named channels, each with an entry per
/// point.
struct PointCloud {
  PointCloud() = default;
  /// Implicit on purpose: points are a cloud without channels.
  PointCloud(Points points_) : points(std::move(points_)) {}  // NOLINT(google-explicit-constructor)

  Points points;
  std::vector<Channel> channels;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
};

/// A cloud from a file: its measured points in the order of the file, and the number of dropped
/// points.
struct LoadedCloud : PointCloud {
  /// Points with a coordinate that is NaN, infinite or too large for a float.
  std::size_t dropped_non_finite = 0;
  /// Points at exactly zero, which drivers write for a ray without a return.
  std::size_t dropped_zero = 0;
  /// Subtracted from every point of the file before its conversion to float, metres: zero, unless
  /// the coordinates are those of a map.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  std::vector<std::string> notes = {};  ///< Sentences that the user should know about the file.
  std::string sha256 = {};  ///< Of the bytes that contained the points; empty without a file.

  /// Appends `point - origin_m` as float if it is a measured point, i.e. finite and not at zero;
  /// otherwise counts it as dropped. Returns whether it was appended.
  bool add(const Eigen::Vector3d& point);
};

/// A channel with one of `values` per point.
template <class Number>
Channel make_channel(const std::string& name, const std::vector<Number>& values) {
  // Memory is little-endian, see docs/design.md.
  return {
      name, scalar_type_of<Number>(), 1,
      std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number))};
}

/// The channel called `name`, or null.
const Channel* find_channel(const PointCloud& cloud, const std::string& name);

/// The first number per point of the channel called `name`. Throws StageError, which lists the
/// existing channels, if the cloud has none of this name.
std::vector<double> channel_values(const PointCloud& cloud, const std::string& name);

/// The firing time of each ray, seconds, from the channel `time` in the unit that `unit_of_times`
/// (framework/geometry/time_unit.hpp) determines. Throws StageError if there is no such channel.
std::vector<double> times_s(const PointCloud& cloud);

/// Adds the channel to the cloud, replacing one of the same name.
void set_channel(PointCloud& cloud, Channel channel);

/// Removes the channels that are not among `names`.
void keep_channels(PointCloud& cloud, const std::set<std::string>& names);

/// The points of `cloud` at `indices` with their channels, in this order.
PointCloud selected(const PointCloud& cloud, const std::vector<std::size_t>& indices);

/// The points of `cloud` whose index satisfies `keep`, with their channels, in their order.
template <class Keep>
PointCloud filtered(const PointCloud& cloud, const Keep& keep) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep(i)) indices.push_back(i);
  }
  return selected(cloud, indices);
}

}  // namespace croon
