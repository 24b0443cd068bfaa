#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The maximum number of faults shown in full; further ones are only counted.
inline constexpr std::size_t kShownFaults = 10;

/// A line of a CSV file supplied by a user.
struct CsvLine {
  std::string header;  ///< The first line of the file.
  std::vector<std::string> fields;
  /// Whether a fault of this line is shown; otherwise expensive messages need not be composed.
  bool is_shown = true;
};

/// Reads the CSV file `path` (RFC 4180), whose first line must be one of `headers`, and calls `add`
/// for each further line. Returns the SHA-256 of the file. Throws one InputError with the first
/// faults of the lines; an InputError thrown by `add` is a fault of its line.
std::string read_given_csv(const std::filesystem::path& path,
                           const std::vector<std::string>& headers,
                           const std::function<void(const CsvLine&)>& add);

/// Throws InputError("expected ..., found ...") for a line.
[[noreturn]] void refuse(const std::string& expected, const std::string& found);

/// Throws InputError unless the line has `count` fields.
void require_fields(const CsvLine& line, std::size_t count);

/// The number in a field; throws InputError if it is not a finite number.
double finite_number(const std::string& text);

/// The same; also throws InputError if its absolute value exceeds `max_size`.
double bounded_number(const std::string& text, double max_size, const std::string& unit);

/// Whether the file `path` begins like a file that `read_given_csv` reads with the header `header`.
bool begins_with_header(const std::filesystem::path& path, const std::string& header);

/// Throws the first of `faults` of `file` and the number of further ones; `more` faults are not in
/// the list.
[[noreturn]] void throw_first(std::vector<Fault> faults, const std::string& file,
                              std::size_t more = 0);

/// The path of the file that `experiment` calls `name`, below `data_root` or else below the folder
/// of the experiment. Throws InputError at the file and position of `at` if there is no such file,
/// or if the path, with links resolved, leaves the folder; `what` is a description such as "a file
/// of starts".
std::filesystem::path found_input(const Experiment& experiment, const std::string& name,
                                  const std::filesystem::path& data_root, const Fault& at,
                                  const std::string& what);

}  // namespace croon::experiments
