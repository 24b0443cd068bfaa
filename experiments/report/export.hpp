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
  std::string commit;  ///< Of the program that made the trials.
  std::uint64_t seed = 1;
  std::size_t scenes = 0;
  int starts = 0;                        ///< Per variant, scene and sensor.
  std::size_t found = 0;                 ///< Trials that the table is over.
  std::size_t planned = 0;               ///< Trials of the whole experiment.
  std::vector<std::string> kinds = {};   ///< Of scenes, if these are chosen.
  std::vector<std::string> builds = {};  ///< See build_sentences.
  int scenes_per_trial = 1;              ///< See Results.
};

/// How the cells of several columns are one for readers: "61.0 -- 100.0", "0.010 ± 0.002".
enum class Joint { none, interval, spread };

/// A column that readers see, of one or two columns of the table.
struct ChosenColumn {
  std::string name;  ///< In `--columns`.
  std::string group;
  std::string title;
  std::vector<std::string> columns;  ///< Full names.
  Joint joint = Joint::none;
};

struct TableChoice;

/// A table for a paper, before it has a format.
struct ExportTable {
  ExportCaption caption;
  SuccessBounds bounds;
  std::string base;  ///< What the marks compare with; empty if nothing is compared.
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  Table table;  ///< By sensor, all together last, then by variant; columns of `export_columns`.
  std::vector<ChosenColumn> chosen = {};  ///< Empty: the full table.
  bool is_in_mm = false;                  ///< Lengths.
  bool is_one_column = false;             ///< For one column of a page with two (LaTeX).
  std::vector<ExportTable> parts = {};    ///< The experiments of a joined table.
};

/// The share of a page that long names take in LaTeX.
inline constexpr double kNameShare = 0.3;

/// A result in numbers: variant, sensor, scenes, trials, success and its interval in percent,
/// median and p95 of the two distances, then mean and std of each DOF in the order of the paper.
Columns<SummaryRow> export_columns();

/// The table of `summary`. If there are several variants the best of each column and sensor is
/// marked, as far as digits are shown: the highest success, the error nearest to zero. Marks
/// compare with the base: "+*" better, "-**" worse and also with scenes as units.
ExportTable export_table(const Summary& summary, const ExportCaption& caption);

/// What is chosen of the table of `summary`. Throws InputError for names that it lacks.
ExportTable export_table(const Summary& summary, const ExportCaption& caption,
                         const TableChoice& choice);

/// What a reader has to know: the experiment, its counts, the meaning of success and of the marks.
/// Plain text, a sentence each.
std::vector<std::string> caption_sentences(const ExportTable& table);

/// A format of `croon export`.
struct ExportFormat {
  const char* name;
  std::string (*bytes)(const ExportTable& table);
};

/// All formats, by name. A new one is a row here and a file that renders it.
const std::vector<ExportFormat>& export_formats();

/// Each format: a line per row in full precision; the rows as objects beside what the caption says;
/// a LaTeX float, whose first line names the packages it needs; a caption and a table as GitHub
/// reads it.
std::string export_csv(const ExportTable& table);
std::string export_json(const ExportTable& table);
std::string export_latex(const ExportTable& table);
std::string export_markdown(const ExportTable& table);

}  // namespace croon::experiments
