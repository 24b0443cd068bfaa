#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// The bytes of the file `path`. Throws InputError if it is not a file or cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// Makes `bytes` the content of the file `path`: writes a file beside it and renames it, so that a
/// reader sees the old content or the new one, never a part. Throws InputError if it cannot be
/// written.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace croon
