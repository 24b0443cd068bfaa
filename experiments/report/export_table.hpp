#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// Where the numbers of an exported table come from.
struct ExportCaption {
  std::string name;    ///< The experiment's.
  std::string commit;  ///< Of the program that made the trials.
  std::uint64_t seed = 1;
  std::size_t scenes = 0;
  int starts = 0;           ///< Per variant, scene and sensor.
  std::size_t found = 0;    ///< Trials that the table is over.
  std::size_t planned = 0;  ///< Trials of the whole experiment.
};

/// Which of two values of a column is the better one.
enum class Better { neither, greater, less, nearer_to_zero };

/// A column of an exported table.
struct ExportColumn {
  std::string name;  ///< "pitch_mean_deg".
  int decimals = 0;  ///< That a reader is shown.
  Better better = Better::neither;
};

/// A number of an exported table.
struct ExportCell {
  std::optional<double> value;  ///< Nothing where too few trials count.
  bool is_best = false;         ///< Among the variants of the sensor, as far as digits are shown.
  std::string mark;  ///< "+*" where it is better than the base's, "-**" worse in scenes too.
};

/// One variant and sensor, or one variant and all sensors together.
struct ExportRow {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  Reference reference = Reference::none;
  int trials = 0;
  int success = 0;  ///< Trials; without truth those that agree.
  int counted = 0;  ///< Trials that the errors are over.
  std::vector<ExportCell> cells;
};

/// What goes into a paper, before it has a format.
struct ExportTable {
  ExportCaption caption;
  SuccessBounds bounds;
  std::string base;  ///< What the marks compare with; empty where nothing is compared.
  std::vector<std::string> variants;
  std::vector<std::string> sensors;
  std::vector<ExportRow> rows;  ///< By sensor, all together last, then by variant.
};

// The columns: success and its interval, the two distances, then mean and std of each DOF in the
// order of the paper.
inline constexpr std::size_t kSuccessColumn = 0;
inline constexpr std::size_t kIntervalColumn = 1;  ///< Low, then high.
inline constexpr std::size_t kDistanceColumn = 3;  ///< Median and p95 of rotation, translation.
inline constexpr std::size_t kFirstDofColumn = 7;  ///< Mean and std of pitch.

/// The columns that have marks: success, the medians of rotation and translation.
inline constexpr std::array<std::size_t, 3> kMarkedColumns = {kSuccessColumn, kDistanceColumn,
                                                              kDistanceColumn + 2};

/// The columns of every exported table.
const std::vector<ExportColumn>& export_columns();

/// The table of `summary`. Where there are several variants the best of each column and sensor is
/// told: the highest success, the least median, p95 and std, the mean nearest to zero.
ExportTable export_table(const Summary& summary, const ExportCaption& caption);

/// What a reader has to know: the experiment, its counts, what success and the marks mean. Plain
/// text, a sentence each.
std::vector<std::string> caption_sentences(const ExportTable& table);

/// The value as a reader is shown it; "-" where there is none.
std::string shown_text(const ExportCell& cell, const ExportColumn& column);

}  // namespace croon::experiments
