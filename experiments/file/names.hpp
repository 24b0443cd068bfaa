#pragma once

#include <string>

namespace croon::experiments {

/// True for a name that can be a folder's: letters, digits, `_`, `.` and `-`, not starting with a
/// dot.
bool is_folder_name(const std::string& name);

/// True for a step's name: letters, digits, `_` and `-`. A dot would end it inside a path of a
/// variant.
bool is_step_name(const std::string& name);

/// True for a variant's name: as a folder's, with spaces inside it. It stands in CSV files and in
/// paths.
bool is_variant_name(const std::string& name);

}  // namespace croon::experiments
