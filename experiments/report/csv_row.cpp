#include "experiments/report/csv_row.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace croon::experiments {

std::string shortest_number(double value) {
  if (value == 0.0) return "0";
  if (std::isnan(value)) return "nan";
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(digits.data(), end);
}

void CsvRow::separate() {
  if (!is_first_) line_ += ',';
  is_first_ = false;
}

CsvRow& CsvRow::text(std::string_view value) {
  separate();
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    line_ += value;
    return *this;
  }
  line_ += '"';
  for (const char c : value) {
    if (c == '"') line_ += '"';
    line_ += c;
  }
  line_ += '"';
  return *this;
}

CsvRow& CsvRow::number(double value) {
  separate();
  line_ += shortest_number(value);
  return *this;
}

CsvRow& CsvRow::count(long long value) {
  separate();
  line_ += std::to_string(value);
  return *this;
}

CsvRow& CsvRow::empty(int fields) {
  for (int i = 0; i < fields; ++i) separate();
  return *this;
}

}  // namespace croon::experiments
