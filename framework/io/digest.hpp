#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// SHA-256 of a file's bytes, 64 hexadecimal digits in small letters. Throws InputError where it
/// cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// SHA-256 of a text.
std::string sha256_of_text(std::string_view text);

}  // namespace croon
