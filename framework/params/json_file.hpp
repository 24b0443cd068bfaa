#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon::params {

/// The JSON value in `text`; `file` is its name in errors. Throws InputError with line and column
/// if the text is not JSON, and for more than 10 MB. Notes in `faults` every duplicate key, of
/// which JSON readers usually keep the last, so that the caller can report other faults too.
nlohmann::json parse_json(const std::string& text, const std::string& file,
                          std::vector<Fault>& faults);

/// The same, but throws InputError for duplicate keys.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// The text of the file `path`, for parse_json. Throws InputError if it cannot be read, or has more
/// than 10 MB; such a file is not read.
std::string read_json_text(const std::filesystem::path& path);

/// The JSON value in the file `path`, in the same two ways. Throws InputError if the file cannot be
/// read.
nlohmann::json read_json_file(const std::filesystem::path& path, std::vector<Fault>& faults);
nlohmann::json read_json_file(const std::filesystem::path& path);

}  // namespace croon::params
