#include "experiments/report/plan_table.hpp"

#include "experiments/report/text.hpp"
#include "experiments/report/text_table.hpp"

namespace croon::experiments {
namespace {

std::vector<std::string> cells(const StepCount& count) {
  const double saved = count.alone == 0 ? 0.0 : 1.0 - static_cast<double>(count.runs) / count.alone;
  return {count.step, std::to_string(count.alone), std::to_string(count.runs),
          std::to_string(count.alone - count.runs), fixed_number(100.0 * saved, 1)};
}

}  // namespace

std::string plan_table(const PlanFigures& plan, bool colours) {
  std::string text = std::to_string(plan.trials) + " trials to run from " +
                     std::to_string(plan.starts) + " starts; " + std::to_string(plan.done) +
                     " are in the store\n";
  if (plan.steps.empty()) return text;
  TextTable table({"step", "one by one", "runs", "saved", "saved %"}, 1);
  StepCount all{"all steps"};
  for (const StepCount& count : plan.steps) {
    table.add(cells(count));
    all.alone += count.alone;
    all.runs += count.runs;
  }
  table.add(cells(all));
  return text + "\n" + table.text(colours);
}

}  // namespace croon::experiments
