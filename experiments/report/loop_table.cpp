#include "experiments/report/row_table.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

std::string loop_table(const Summary& summary, const TableStyle& style) {
  RowTable table(summary, {"loop"},
                 {"closed", "%", "95 % interval", "rotation deg", "translation m"});
  for (const LoopClosure& loop : summary.loops) {
    std::vector<std::string> cells = {share_text(loop.closed), percent(loop.closed.ratio),
                                      interval_text(loop.closed)};
    for (std::size_t k = kDofs; k < kMeasures.size(); ++k) {
      cells.push_back(loop.statistics ? median_and_p95((*loop.statistics)[k], kMeasures[k]) : "-");
    }
    table.add(loop.variant, {loop.pair.name}, cells);
  }
  return table.text(style);
}

}  // namespace croon::experiments
