#pragma once

#include <filesystem>
#include <string>

namespace croon {

/// Where symbolic links may lead.
enum class Links { inside, anywhere };

/// The path of `relative` below the folder `data_root`, with `..` resolved; the real path unless
/// links may lead anywhere. Throws InputError if the root is not a folder, or if the path does not
/// exist or leads outside the root, by a link too unless links may lead anywhere.
std::filesystem::path path_in_data_root(const std::filesystem::path& data_root,
                                        const std::string& relative, Links links = Links::inside);

/// Whether `path` is `folder` or below it; both must be real paths (std::filesystem::canonical).
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace croon
