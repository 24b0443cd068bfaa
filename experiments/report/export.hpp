#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "framework/table/table.hpp"

namespace croon::experiments {

/// The run that the numbers of an exported table come from.
struct ExportCaption {
  std::string name;    ///< The experiment's.
  std::string commit;  ///< Commit of the program that made the trials.
  std::uint64_t seed = 1;
  std::size_t scenes = 0;
  int starts = 0;                        ///< Per variant, scene and sensor.
  std::size_t found = 0;                 ///< Trials included in the table.
  std::size_t planned = 0;               ///< Trials of the complete experiment.
  std::vector<std::string> kinds = {};   ///< Chosen kinds of scenes; empty: all.
  std::vector<std::string> builds = {};  ///< See build_sentences.
  int scenes_per_trial = 1;              ///< See Results.
};

/// The titles of statistics that have two numbers in a cell.
inline constexpr const char* kMeanAndStd = "mean ± std";
inline constexpr const char* kShareInterval = "95 % interval";
inline constexpr const char* kPairedInterval = "paired";

/// A column for readers: a count, or a statistic of a share or measure.
struct ExportColumn {
  std::string name;                  ///< In `--columns`: "x_p95".
  std::string subject;               ///< "x", "success"; empty for counts.
  std::string unit;                  ///< "deg", "m", "mm" or "%".
  std::string statistic;             ///< "p95", "rate", `kMeanAndStd`; the name of a count.
  std::vector<std::string> columns;  ///< Full names of one or two columns of the table.

  /// "x (mm)".
  std::string group() const { return subject.empty() ? "" : subject + " (" + unit + ")"; }
};

struct TableChoice;

/// A table for a paper, independent of its format.
struct ExportTable {
  ExportCaption caption;
  SuccessBounds bounds;
  std::string base;  ///< The variant that marks compare with; empty if nothing is compared.
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  Table table;  ///< By sensor (all sensors together last), then variant; `export_columns`.
  std::vector<ExportColumn> chosen = {};  ///< Empty: the full table.
  bool is_in_mm = false;                  ///< Whether lengths are in millimetres.
  bool is_one_column = false;             ///< For one column of a two-column page (LaTeX).
  std::vector<ExportTable> parts = {};    ///< The experiments of a joined table.
};

/// A result in numbers: variant, sensor, scenes, trials, success and its interval in percent,
/// median and p95 of the two distances, then mean and std of each DOF in the order of the paper.
Columns<SummaryRow> export_columns();

/// The table of `summary`. With several variants, the best value of each column and sensor is
/// marked, compared at the displayed precision: the highest success, the error nearest to zero.
/// Marks compare with the base: "+*" better, "-**" worse and also with scenes as units.
ExportTable export_table(const Summary& summary, const ExportCaption& caption);

/// The chosen part of the table of `summary`. Throws InputError for unknown names.
ExportTable export_table(const Summary& summary, const ExportCaption& caption,
                         const TableChoice& choice);

/// Sentences that define success and agreement, as far as a table with a column "reference" shows
/// them.
std::vector<std::string> share_sentences(const Table& table, const SuccessBounds& of_success);

/// The caption, one plain-text sentence each: the experiment, its counts, the meaning of success
/// and of the marks.
std::vector<std::string> caption_sentences(const ExportTable& table);

/// A format of `croon export`.
struct ExportFormat {
  const char* name;
  bool fits_page;  ///< Whether a table must fit a page, so that its columns are always chosen.
  std::string (*bytes)(const ExportTable& table);
};

/// All formats, by name. A new format is a row here and a file that renders it.
const std::vector<ExportFormat>& export_formats();

/// The formats. CSV: a line per row in full precision. JSON: the rows as objects and the content of
/// the caption. LaTeX: a float whose first line names the required packages; throws InputError if
/// it is wider than the page. Markdown: a caption and a table for GitHub.
std::string export_csv(const ExportTable& table);
std::string export_json(const ExportTable& table);
std::string export_latex(const ExportTable& table);
std::string export_markdown(const ExportTable& table);

}  // namespace croon::experiments
