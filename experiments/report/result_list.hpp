#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"

namespace croon::experiments {

/// A table or figure in a folder of results.
struct ResultFile {
  std::string name;
  /// The bytes of the file; std::nullopt if these results have no such file.
  std::function<std::optional<std::string>(const Results& results)> bytes;
};

/// All tables, and all figures() as SVG. A new table is a row here.
const std::vector<ResultFile>& result_files();

/// The bytes of the file `name`; empty if these results have no such file. Throws std::out_of_range
/// for a name that is not in the list.
std::string result_file(const std::string& name, const Results& results);

}  // namespace croon::experiments
