#include "experiments/report/row_table.hpp"

#include <algorithm>
#include <utility>

#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kLongName = 16;

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

RowTable::RowTable(const Summary& summary, std::vector<std::string> names,
                   const std::vector<std::string>& columns) {
  const std::vector<std::string> variants = variants_of(summary);
  std::size_t longest = 0;
  for (const std::string& variant : variants) longest = std::max(longest, text_columns(variant));
  if (variants.size() > 1) {
    place_ = longest > kLongName ? VariantPlace::heading : VariantPlace::column;
  }
  if (place_ == VariantPlace::column) names.insert(names.begin(), "variant");
  const std::size_t name_count = names.size();
  append(names, columns);
  table_.emplace(std::move(names), name_count);
}

void RowTable::add(const std::string& variant, std::vector<std::string> names,
                   const std::vector<std::string>& cells) {
  if (place_ == VariantPlace::column) names.insert(names.begin(), variant);
  if (place_ == VariantPlace::heading && last_variant_ != variant) table_->add_heading(variant);
  last_variant_ = variant;
  append(names, cells);
  table_->add(std::move(names));
}

const Share& main_share(const SummaryRow& row) {
  return row.reference == Reference::consensus ? row.agreement : row.success;
}

const Share& main_share(const SummaryRow& row, const SceneSummary& scene) {
  return row.reference == Reference::consensus ? scene.agreement : scene.success;
}

const Share& main_share(const KindSummary& kind) {
  return kind.reference == Reference::consensus ? kind.agreement : kind.success;
}

std::string percent(double ratio) { return fixed_number(100.0 * ratio, 1); }

std::string interval_text(const Share& share) {
  return "[" + percent(share.interval.low) + ", " + percent(share.interval.high) + "]";
}

int decimals_of(const Measure& measure) { return std::string(measure.unit) == "m" ? 4 : 3; }

std::string median_and_p95(const MeasureStatistics& statistics, const Measure& measure) {
  const int decimals = decimals_of(measure);
  return fixed_number(statistics.median, decimals) + ", " + fixed_number(statistics.p95, decimals);
}

std::string share_text(const Share& share) {
  return std::to_string(share.count) + "/" + std::to_string(share.trials);
}

}  // namespace croon::experiments
