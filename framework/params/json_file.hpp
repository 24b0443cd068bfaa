#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace croon::params {

/// The JSON value in `path`. Throws InputError with line and column where it is not JSON, and with the JSON
/// pointer of every duplicate key (which JSON readers commonly let pass, keeping the last).
nlohmann::json read_json_file(const std::filesystem::path& path);

/// The same for text that is already there; `file` is its name in errors.
nlohmann::json parse_json(const std::string& text, const std::string& file);

}  // namespace croon::params
