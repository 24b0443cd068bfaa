#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The name of the channel in each of the fields of a file, in their order; empty for x, y, z, for
/// padding ("_") and for a second field of one name. What drivers call "timestamp", "t",
/// "offset_time", "i" or "laser_id" is the channel "time", "intensity" or "ring", unless another
/// field is called so; words are known in capitals too.
std::vector<std::string> channel_names(const std::vector<std::string>& fields);

/// The field that the channel `name` of `cloud` is written to: "timestamp" for "time", as the
/// authors' samples have it, unless another channel has a name that is read as "time"; the
/// channel's name for others.
std::string field_name(const std::string& name, const PointCloud& cloud);

/// Throws InputError unless the channels of `cloud` can be fields of the file `path`: each as long
/// as the points, with a name of its own that is one word and that the reader gives it again.
void check_writable(const PointCloud& cloud, const std::filesystem::path& path);

}  // namespace croon
