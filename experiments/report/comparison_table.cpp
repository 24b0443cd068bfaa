#include "experiments/report/row_table.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

std::string p_text(const PairedTest& test) {
  const char* mark = holds_by_scene(test) ? "**" : is_significant(test) ? "*" : "";
  return (test.p_holm < 0.001 ? "<0.001" : fixed_number(test.p_holm, 3)) + mark;
}

std::string difference_text(const ErrorComparison& error, int decimals) {
  const auto text = [&](double value) { return fixed_number(value, decimals); };
  return text(error.difference) + " [" + text(error.interval.low) + ", " +
         text(error.interval.high) + "]";
}

}  // namespace

std::string comparison_table(const Summary& summary, const TableStyle& style) {
  RowTable table(summary, {},
                 {"pairs", "won", "lost", "p", "rotation deg", "p", "translation m", "p"});
  for (const Comparison& comparison : summary.comparisons) {
    if (!comparison.sensor.empty()) continue;
    const ErrorComparison& rotation = comparison.rotation_deg;
    const ErrorComparison& translation = comparison.translation_m;
    table.add(comparison.variant, {},
              {std::to_string(comparison.pairs), std::to_string(comparison.only_variant),
               std::to_string(comparison.only_base), p_text(comparison.success),
               difference_text(rotation, 3), p_text(rotation.test), difference_text(translation, 4),
               p_text(translation.test)});
  }
  return table.text(style) +
         "* p < 0.05 over trials (McNemar, Wilcoxon; Holm), ** also with scenes as units\n";
}

}  // namespace croon::experiments
