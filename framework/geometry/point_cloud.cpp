#include "framework/geometry/point_cloud.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/geometry/time_unit.hpp"

namespace croon {
namespace {

const Channel& channel_of(const PointCloud& cloud, const std::string& name) {
  if (const Channel* channel = find_channel(cloud, name)) return *channel;
  std::string found;
  for (const Channel& channel : cloud.channels) {
    found += (found.empty() ? "it has " : ", ") + channel.name;
  }
  throw StageError("the cloud has no channel \"" + name + "\"; " +
                   (found.empty() ? "it has none" : found));
}

}  // namespace

bool LoadedCloud::add(const Eigen::Vector3d& point) {
  const Eigen::Vector3f rounded = (point - origin_m).cast<float>();
  const bool is_finite = rounded.allFinite();
  // The second condition ensures that a cloud that is written and read again stays the same.
  const bool is_zero = is_finite && (point.cast<float>().isZero(0.0F) || rounded.isZero(0.0F));
  if (is_finite && !is_zero) points.push_back(rounded);
  if (!is_finite) ++dropped_non_finite;
  if (is_zero) ++dropped_zero;
  return is_finite && !is_zero;
}

const Channel* find_channel(const PointCloud& cloud, const std::string& name) {
  for (const Channel& channel : cloud.channels) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

std::vector<double> channel_values(const PointCloud& cloud, const std::string& name) {
  const Channel& channel = channel_of(cloud, name);
  std::vector<double> values(cloud.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = channel.value(i);
  return values;
}

std::vector<double> times_s(const PointCloud& cloud) {
  std::vector<double> times = channel_values(cloud, kTime);
  const ScalarKind kind = channel_of(cloud, kTime).type.kind;
  const double unit_s = seconds_of(unit_of_times(times, kind));
  if (unit_s != 1.0) {
    for (double& time : times) time *= unit_s;
  }
  return times;
}

void set_channel(PointCloud& cloud, Channel channel) {
  const auto is_of_its_name = [&](const Channel& other) { return other.name == channel.name; };
  const auto old = std::find_if(cloud.channels.begin(), cloud.channels.end(), is_of_its_name);
  if (old == cloud.channels.end()) {
    cloud.channels.push_back(std::move(channel));
  } else {
    *old = std::move(channel);
  }
}

void keep_channels(PointCloud& cloud, const std::set<std::string>& names) {
  const auto is_other = [&](const Channel& channel) { return names.count(channel.name) == 0; };
  cloud.channels.erase(std::remove_if(cloud.channels.begin(), cloud.channels.end(), is_other),
                       cloud.channels.end());
}

PointCloud selected(const PointCloud& cloud, const std::vector<std::size_t>& indices) {
  PointCloud result;
  result.points.reserve(indices.size());
  for (const std::size_t i : indices) result.points.push_back(cloud.points[i]);
  for (const Channel& channel : cloud.channels) {
    Channel& kept = result.channels.emplace_back();
    kept = {channel.name, channel.type, channel.count, {}};
    const std::size_t each = channel.bytes_per_point();
    kept.bytes.reserve(indices.size() * each);
    for (const std::size_t i : indices) kept.bytes.append(channel.bytes, i * each, each);
  }
  return result;
}

}  // namespace croon
