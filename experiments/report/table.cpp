#include "experiments/report/table.hpp"

#include <stdexcept>

#include "framework/base/text.hpp"

namespace croon::experiments {

std::size_t Table::index_of(const std::string& full_name) const {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].full_name() == full_name) return k;
  }
  throw std::logic_error("no column is called \"" + full_name + "\"");
}

const std::string& Table::text_at(std::size_t row, const std::string& full_name) const {
  static const std::string kNothing;
  const std::string* const text = std::get_if<std::string>(&at(row, full_name).value);
  return text == nullptr ? kNothing : *text;
}

std::string shown_text(const Cell& cell, const Column& column) {
  if (cell.is_nothing()) return column.is_all_if_nothing ? "all " + column.name + "s" : "-";
  if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
  if (const auto* count = std::get_if<long long>(&cell.value)) return std::to_string(*count);
  if (const auto* is_true = std::get_if<bool>(&cell.value)) return *is_true ? "yes" : "no";
  const double value = std::get<double>(cell.value) * (column.unit == "ratio" ? 100.0 : 1.0);
  const int decimals = cell.decimals.value_or(column.decimals);
  return decimals == kAllDigits ? plain_number(value) : fixed_number(value, decimals);
}

}  // namespace croon::experiments
