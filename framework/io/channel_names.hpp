#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The name of the channel in each field of a file, in the order of the fields; empty for x, y, z,
/// for padding ("_") and for a duplicate name. Fields that drivers name "timestamp", "t",
/// "offset_time", "i" or "laser_id" are the channels "time", "intensity" or "ring", unless another
/// field has that name; all-capital names are recognised too.
std::vector<std::string> channel_names(const std::vector<std::string>& fields);

/// The field to which the channel `name` of `cloud` is written: "timestamp" for "time", as in the
/// authors' samples, unless another channel has a name that is read as "time"; otherwise the name
/// of the channel.
std::string field_name(const std::string& name, const PointCloud& cloud);

/// Throws InputError unless the channels of `cloud` can be fields of the file `path`: each has the
/// length of the points and a distinct name of one word that is read back unchanged.
void check_writable(const PointCloud& cloud, const std::filesystem::path& path);

}  // namespace croon
