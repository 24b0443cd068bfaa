#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// What the file is and how to convert it, for a message: "a LAS file; convert it: pdal translate
/// ...". By its first bytes, else by its suffix; empty if it is no format that is known by name.
std::string foreign_format(std::string_view head, const std::filesystem::path& path);

}  // namespace croon
