#pragma once

#include <string>

#include "experiments/report/export_table.hpp"

namespace croon::experiments {

/// A LaTeX float with booktabs rules and siunitx columns (version 2 or 3), the best values bold:
/// what it wants in the preamble stands at its head.
std::string export_latex(const ExportTable& table);

/// The caption, then a table as GitHub reads it, the best values bold.
std::string export_markdown(const ExportTable& table);

/// A line per row, full precision. All sensors together are "all".
std::string export_csv(const ExportTable& table);

/// The rows as objects, full precision, beside what the caption says; null where there is no
/// number, and for the sensor where it is all of them.
std::string export_json(const ExportTable& table);

/// `text` as LaTeX prints it, wherever it stands in a cell or a sentence.
std::string latex_escaped(const std::string& text);

/// The same of a name, which may be broken behind its signs.
std::string latex_breakable(const std::string& name);

/// `text` as Markdown shows it in a cell or a sentence.
std::string markdown_escaped(const std::string& text);

}  // namespace croon::experiments
