#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon::params {

/// The JSON value in `text`; `file` is its name in errors. Throws InputError with line and column
/// where it is not JSON. Notes in `faults` the JSON pointer of every duplicate key, which JSON
/// readers commonly let pass (keeping the last), so that whoever reads the value can say what else
/// is wrong with it.
nlohmann::json parse_json(const std::string& text, const std::string& file,
                          std::vector<Fault>& faults);

/// The same; duplicate keys are thrown.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// The JSON value in the file `path`, in the same two ways. Throws InputError where it cannot be
/// read.
nlohmann::json read_json_file(const std::filesystem::path& path, std::vector<Fault>& faults);
nlohmann::json read_json_file(const std::filesystem::path& path);

}  // namespace croon::params
