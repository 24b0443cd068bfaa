#pragma once

#include <filesystem>
#include <string>

namespace croon {

/// The real path of `relative` below the folder `data_root`, with symbolic links and `..` resolved.
/// Throws InputError if the root is not a folder, or if the path does not exist or leads outside
/// the root.
std::filesystem::path path_in_data_root(const std::filesystem::path& data_root,
                                        const std::string& relative);

/// Whether `path` is `folder` or below it; both must be real paths (std::filesystem::canonical).
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace croon
