#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"

namespace croon {

/// A file cannot be read at the moment, or is no longer the same file. This does not depend on its
/// content, so it must not become a result: another attempt may succeed.
class UnavailableFile : public InputError {
 public:
  using InputError::InputError;
};

/// The word for a message that expected a file at `path`: "none", "a folder", "a link that leads
/// nowhere", or "something that is not a file". Other links are followed.
std::string found_instead_of_file(const std::filesystem::path& path);

/// The bytes of the file `path`. Throws UnavailableFile if it cannot be read or is too large.
std::string read_whole_file(const std::filesystem::path& path);

/// The same; std::nullopt if nothing exists at `path`, not even a link.
std::optional<std::string> read_file_if_there(const std::filesystem::path& path);

/// Whether `path` is a file, not a link, that begins with `bytes`. False if it cannot be read.
bool file_begins_with(const std::filesystem::path& path, std::string_view bytes);

/// Whether `path` is a file, not a link, whose content is exactly `bytes`.
bool file_has(const std::filesystem::path& path, std::string_view bytes);

/// Replaces the content of the file `path` with `bytes`: writes a temporary file next to it and
/// renames that, so that a reader sees either the old or the new content, never a part. Throws
/// InputError if it cannot be written. If the process is killed, the temporary file
/// `PATH.croon-part0` remains; the next call for `path` reuses it.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

/// The same for bytes in parts: `write` passes them to its argument one after the other. If it
/// throws, the file keeps its content.
void write_in_parts(const std::filesystem::path& path,
                    const std::function<void(const std::function<void(std::string_view)>&)>& write);

/// Creates the folder `relative` below the existing folder `root`, with all folders between. Throws
/// InputError if a folder cannot be created or is a symbolic link, through which files would land
/// elsewhere.
void make_folder_below(const std::filesystem::path& root, const std::filesystem::path& relative);

/// Whether `part` is a temporary file that a killed `write_whole_file` of `path` left behind.
bool is_part_of(const std::filesystem::path& part, const std::filesystem::path& path);

}  // namespace croon
