#pragma once

#include <string>
#include <string_view>

namespace croon::experiments {

/// `value` in the fewest digits that read back as the same bits (std::to_chars); zero and
/// "nan" never have a sign.
std::string shortest_number(double value);

/// A line of a CSV file (RFC 4180, but lines end in "\n"), built field by field.
class CsvRow {
 public:
  /// Text, quoted where it holds a comma, a quote or a line break.
  CsvRow& text(std::string_view value);
  CsvRow& number(double value);
  CsvRow& count(long long value);
  /// Fields that are not known.
  CsvRow& empty(int fields = 1);
  /// The line with its end.
  std::string line() const { return line_ + "\n"; }

 private:
  void separate();

  std::string line_;
  bool is_first_ = true;
};

}  // namespace croon::experiments
