#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon {

namespace {

struct ValueText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool value) const { return value ? "1" : "0"; }
  std::string operator()(long long value) const { return std::to_string(value); }
  std::string operator()(double value) const { return shortest_number(value); }
  std::string operator()(const std::string& value) const {
    if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
    std::string quoted = "\"";
    for (const char c : value) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
  }
};

}  // namespace

std::string csv_line(const std::vector<Column>& columns, const CellRow& row) {
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const bool is_all = columns[k].is_all_if_nothing && row[k].is_nothing();
    line += (k > 0 ? "," : "") + (is_all ? "all" : std::visit(ValueText(), row[k].value));
  }
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (columns[k].has_marks) line += "," + row[k].mark;
  }
  return line + "\n";
}

std::string csv_header(const std::vector<Column>& columns) {
  CellRow names;
  for (const Column& column : columns) {
    names.push_back(to_cell(column.full_name()));
    names.back().mark = column.full_name() + "_mark";
  }
  return csv_line(columns, names);
}

std::string csv_table(const Table& table) {
  std::string bytes = csv_header(table.columns);
  for (const CellRow& row : table.rows) bytes += csv_line(table.columns, row);
  return bytes;
}

}  // namespace croon
