#pragma once

#include <string>
#include <vector>

namespace croon::benchmarks {

/// The value with three significant digits.
std::string three_digits(double value);

/// A row of a table.
std::string row_of(const std::vector<std::string>& cells);

/// The head of a table; all columns but the first are right-aligned.
std::string header_of(const std::vector<std::string>& titles);

/// The name in backquotes.
std::string code(const std::string& name);

}  // namespace croon::benchmarks
