#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// So many faults are shown; the others are counted.
inline constexpr std::size_t kShownFaults = 10;

/// A line of a CSV file that a user gives.
struct CsvLine {
  std::string header;  ///< The first line of the file.
  std::vector<std::string> fields;
  /// Whether a fault of this line is shown; if not, what takes long to say need not be said.
  bool is_shown = true;
};

/// Reads the CSV file `path` (RFC 4180), whose first line must be one of `headers`, and calls `add`
/// for each line after it. Returns the SHA-256 of the file. Throws one InputError with the first
/// faults of the lines; an InputError of `add` is a fault of its line.
std::string read_given_csv(const std::filesystem::path& path,
                           const std::vector<std::string>& headers,
                           const std::function<void(const CsvLine&)>& add);

/// Throws the InputError of a line: expected ..., found ...
[[noreturn]] void refuse(const std::string& expected, const std::string& found);

/// Refuses a line that has not so many fields.
void require_fields(const CsvLine& line, std::size_t count);

/// The number of a field; refuses what is none or is not finite.
double finite_number(const std::string& text);

/// The same, and refuses what is larger than `most` or below its negative.
double bounded_number(const std::string& text, double most, const std::string& unit);

/// Whether the file `path` begins as one that `read_given_csv` reads with the header `header`.
bool begins_with_header(const std::filesystem::path& path, const std::string& header);

/// Throws the first of `faults` of `file`, and how many more there are; `more` are not in the list.
[[noreturn]] void throw_first(std::vector<Fault> faults, const std::string& file,
                              std::size_t more = 0);

/// The file that `experiment` names as `name`, below `data_root`, else below the folder of the
/// experiment. Throws InputError at the file and position of `at` if there is none, or if the path
/// with its links leaves the folder; `what` is "a file of starts".
std::filesystem::path found_input(const Experiment& experiment, const std::string& name,
                                  const std::filesystem::path& data_root, const Fault& at,
                                  const std::string& what);

}  // namespace croon::experiments
