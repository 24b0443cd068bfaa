#pragma once

#include <filesystem>
#include <string>

namespace croon {

/// Where symbolic links may point: inside the data root only, or anywhere.
enum class Links { inside, anywhere };

/// The path of `relative` below the folder `data_root`, with `..` resolved; the real path unless
/// links may point anywhere. Throws InputError if the root is not a folder, or if the path does not
/// exist or is outside the root, also through a link unless links may point anywhere. If the path
/// is a parameter of a dataset, `pointer` is its JSON pointer ("/path"), at which faults are
/// reported.
std::filesystem::path path_in_data_root(const std::filesystem::path& data_root,
                                        const std::string& relative, Links links = Links::inside,
                                        const std::string& pointer = "");

/// A hint for a path that does not exist: `; did you mean "rig/real"?` with the nearest name in the
/// last existing folder of `relative` below `folder`. If no name is near, the names there if they
/// are few (`; known: a, b`), otherwise empty. Empty if the path leaves the folder. An empty
/// `folder` means the working directory, which the path may leave.
std::string missing_path_hint(const std::filesystem::path& folder,
                              const std::filesystem::path& relative);

/// Whether `path` is `folder` or below it; both must be real paths (std::filesystem::canonical).
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace croon
