#pragma once

#include <cstddef>
#include <string>

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// How `croon run` shows a summary.
struct TableStyle {
  bool colours = false;         ///< Only where the output is a terminal.
  std::size_t max_reasons = 5;  ///< Reasons for failures that are shown, the most frequent first.
  std::size_t max_scenes = 12;  ///< Rows of the table per scene; the worst are kept.
};

/// What `croon run` prints on stdout, in UTF-8, within 120 columns for names of ordinary length:
/// success and mean ± std per DOF of every variant and sensor, success per scene, reasons for
/// failures. Ends with a newline.
std::string summary_table(const Summary& summary, const TableStyle& style = {});

}  // namespace croon::experiments
