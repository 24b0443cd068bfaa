#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

struct ValueText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool value) const { return value ? "1" : "0"; }
  std::string operator()(long long value) const { return std::to_string(value); }
  std::string operator()(double value) const { return shortest_number(value); }
  std::string operator()(const std::string& value) const { return quoted(value); }
};

std::string field(const Cell& cell, const Column& column) {
  const bool is_all = column.is_all_if_nothing && cell.is_nothing();
  return is_all ? "all" : std::visit(ValueText(), cell.value);
}

/// The line of `fields`, which must not be empty.
std::string line_of(const std::vector<std::string>& fields) {
  std::string line = fields.front();
  for (std::size_t k = 1; k < fields.size(); ++k) line += "," + fields[k];
  return line + "\n";
}

}  // namespace

std::string csv_header(const std::vector<Column>& columns) {
  std::vector<std::string> fields;
  for (const Column& column : columns) fields.push_back(quoted(column.full_name()));
  for (const Column& column : columns) {
    if (column.has_marks) fields.push_back(column.full_name() + "_mark");
  }
  return line_of(fields);
}

std::string csv_line(const std::vector<Column>& columns, const CellRow& row) {
  std::vector<std::string> fields;
  for (std::size_t k = 0; k < row.size(); ++k) fields.push_back(field(row[k], columns[k]));
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (columns[k].has_marks) fields.push_back(row[k].mark);
  }
  return line_of(fields);
}

std::string csv_table(const Table& table) {
  std::string bytes = csv_header(table.columns);
  for (const CellRow& row : table.rows) bytes += csv_line(table.columns, row);
  return bytes;
}

std::string export_csv(const ExportTable& table) { return csv_table(table.table); }

}  // namespace croon::experiments
