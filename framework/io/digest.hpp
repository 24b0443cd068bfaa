#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// SHA-256 of a file's bytes, 64 lower-case hexadecimal digits. Throws InputError if it cannot be
/// read.
std::string sha256_of_file(const std::filesystem::path& path);

/// SHA-256 of a text, in the same form.
std::string sha256_of_text(std::string_view text);

}  // namespace croon
