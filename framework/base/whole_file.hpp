#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"

namespace croon {

/// A file cannot be read now, or is not the one that was there before. This is no property of its
/// content, so it must not become a result: another attempt may succeed.
class UnavailableFile : public InputError {
 public:
  using InputError::InputError;
};

/// What a message says that was found at `path`, if it is no file: none, a folder, a link that
/// leads nowhere, or something else. Other links are followed.
std::string found_instead_of_file(const std::filesystem::path& path);

/// The bytes of the file `path`. Throws UnavailableFile if it cannot be read or is too large.
std::string read_whole_file(const std::filesystem::path& path);

/// The same; std::nullopt if nothing is there, no link either.
std::optional<std::string> read_file_if_there(const std::filesystem::path& path);

/// Whether `path` is a file, and no link, that begins with `bytes`. False if it cannot be read.
bool file_begins_with(const std::filesystem::path& path, std::string_view bytes);

/// Whether `path` is a file, and no link, with these bytes and no others.
bool file_has(const std::filesystem::path& path, std::string_view bytes);

/// Makes `bytes` the content of the file `path`: writes a file beside it and renames it, so that a
/// reader sees the old content or the new one, never a part. Throws InputError if it cannot be
/// written. The file beside it, `PATH.croon-part0`, stays if the process is killed; the next call
/// for `path` takes it.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes the folder `relative` below `root`, which is there, with all folders between. Throws
/// InputError if it cannot be made, or if one of them is a symbolic link: what is written there
/// would land elsewhere.
void make_folder_below(const std::filesystem::path& root, const std::filesystem::path& relative);

/// Whether `part` is a file that a killed `write_whole_file` of `path` left.
bool is_part_of(const std::filesystem::path& part, const std::filesystem::path& path);

}  // namespace croon
