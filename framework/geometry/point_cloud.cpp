#include "framework/geometry/point_cloud.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace croon {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

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
  const Eigen::Vector3f rounded = point.cast<float>();
  const bool is_finite = rounded.allFinite();
  if (is_finite) {
    points.push_back(rounded);
  } else {
    ++dropped_non_finite;
  }
  return is_finite;
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
  if (channel_of(cloud, kTime).type.kind != ScalarKind::floating) {
    for (double& time : times) time *= kSecondsPerNanosecond;
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
