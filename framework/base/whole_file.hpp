#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// The bytes of the file `path`. Throws InputError if it is not a file or cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// Makes `bytes` the content of the file `path`: writes a file beside it and renames that, so that
/// whoever looks sees the old content or the new, never half of it. Throws InputError where that
/// cannot be done.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace croon
