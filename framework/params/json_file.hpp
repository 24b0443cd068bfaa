#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon::params {

/// The JSON value in `text`; `file` is its name in errors. Throws InputError with line and column
/// if the text is not JSON or has more than 10 MB. Notes every duplicate key in `faults`, so that
/// the caller can report other faults too; the last of its values is kept.
nlohmann::json parse_json(const std::string& text, const std::string& file,
                          std::vector<Fault>& faults);

/// The same, but throws InputError for duplicate keys.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// The text of the file `path`, for parse_json. Throws InputError if it cannot be read or has more
/// than 10 MB.
std::string read_json_text(const std::filesystem::path& path);

/// The JSON value in the file `path`, in the same two variants. Throws InputError if the file
/// cannot be read.
nlohmann::json read_json_file(const std::filesystem::path& path, std::vector<Fault>& faults);
nlohmann::json read_json_file(const std::filesystem::path& path);

}  // namespace croon::params
