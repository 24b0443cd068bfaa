#pragma once

#include <filesystem>
#include <string>

namespace croon {

/// Where symbolic links may lead.
enum class Links { inside, anywhere };

/// The path of `relative` below the folder `data_root`, with `..` resolved; the real path unless
/// links may lead anywhere. Throws InputError if the root is not a folder, or if the path does not
/// exist or leads outside the root, by a link too unless links may lead anywhere. If the path is a
/// parameter of a dataset, `pointer` is that of the parameter ("/path"): then a fault of the path
/// is at the pointer, without a file.
std::filesystem::path path_in_data_root(const std::filesystem::path& data_root,
                                        const std::string& relative, Links links = Links::inside,
                                        const std::string& pointer = "");

/// For a path that does not exist: `; did you mean "rig/real"?` with the nearest name in the last
/// folder of `relative` that exists below `folder`. If no name is near, the names there if they are
/// few (`; known: a, b`), else empty. Empty if the path leaves the folder. An empty `folder` is the
/// working directory, which the path may leave.
std::string missing_path_hint(const std::filesystem::path& folder,
                              const std::filesystem::path& relative);

/// Whether `path` is `folder` or below it; both must be real paths (std::filesystem::canonical).
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace croon
