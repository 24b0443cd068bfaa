#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace croon {

/// The SHA-256 of a file's bytes as 64 lower-case hexadecimal digits. Throws InputError if it
/// cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// The SHA-256 of a text, in the same form.
std::string sha256_of_text(std::string_view text);

}  // namespace croon
