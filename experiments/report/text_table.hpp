#pragma once

#include <string>
#include <vector>

namespace croon::experiments {

/// Rows of text in aligned columns, as terminals show them.
class TextTable {
 public:
  /// The first `names` columns are text, aligned to the left; the rest are numbers, aligned to the
  /// right.
  TextTable(std::vector<std::string> header, std::size_t names);

  /// A row with a cell per column.
  void add(std::vector<std::string> cells);
  /// A line of its own between the rows, not aligned.
  void add_heading(std::string text);
  /// The header and the rows, a line each, the header underlined; `bold_header` for a terminal.
  std::string text(bool bold_header) const;

 private:
  std::string line(const std::vector<std::string>& cells) const;

  std::vector<std::string> header_;
  std::size_t names_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;  ///< One cell: a heading.
};

}  // namespace croon::experiments
