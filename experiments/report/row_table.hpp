#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/report/summary.hpp"
#include "experiments/report/table.hpp"
#include "experiments/report/text_table.hpp"

namespace croon::experiments {

/// A text table whose rows belong to variants: a column names them; where a name is long, a line
/// above its rows; where there is one variant alone, nothing does.
class RowTable {
 public:
  /// `names` are columns of text, `columns` are columns of numbers.
  RowTable(const Summary& summary, std::vector<std::string> names,
           const std::vector<std::string>& columns);

  void add(const std::string& variant, std::vector<std::string> names,
           const std::vector<std::string>& cells);
  std::string text(const TableStyle& style) const { return table_->text(style.colours); }

 private:
  enum class VariantPlace { nowhere, column, heading };

  VariantPlace place_ = VariantPlace::nowhere;
  std::optional<std::string> last_variant_;
  std::optional<TextTable> table_;
};

/// The share that counts as success in tables: with truth of trials near it, else of those that
/// agree.
const Share& main_share(const SummaryRow& row);
const Share& main_share(const SummaryRow& row, const SceneSummary& scene);
const Share& main_share(const KindSummary& kind);

/// "248/250".
std::string share_text(const Share& share);

/// 0.253 as "25.3".
std::string percent(double ratio);

/// "[9.7, 70.0]", in percent.
std::string interval_text(const Share& share);

/// As many decimals as methods differ by and the paper's tables show: millimetres are worth four,
/// degrees three.
int decimals_of(const Measure& measure);

/// "0.024, 0.035".
std::string median_and_p95(const MeasureStatistics& statistics, const Measure& measure);

/// Success in % per variant, kind of scene (rows) and sensor (columns).
std::string kind_table(const Summary& summary, const TableStyle& style);

/// Every variant against the first, all sensors together: pairs won and lost, the differences of
/// the median errors with their intervals, corrected p values with their marks.
std::string comparison_table(const Summary& summary, const TableStyle& style);

/// Per variant and pair of sensors, how many loops close and how far they are from closing.
std::string loop_table(const Summary& summary, const TableStyle& style);

/// Success per variant, scene (rows) and sensor (columns). Of more than `style.max_scenes` rows the
/// worst are shown, in their order.
std::string scene_table(const Summary& summary, const TableStyle& style);

}  // namespace croon::experiments
