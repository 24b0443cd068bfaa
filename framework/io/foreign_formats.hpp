#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// The file's format and how to convert it, for a message: "a LAS file; convert it: pdal translate
/// ...". Recognised by the first bytes or else by the suffix; empty if unknown.
std::string foreign_format(std::string_view head, const std::filesystem::path& path);

}  // namespace croon
