#include "experiments/analysis/step_times.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "framework/base/statistics.hpp"

namespace croon::experiments {
namespace {

/// The times of a step, one per trial.
struct TimedStep {
  std::string name;
  std::vector<double> seconds;
};

}  // namespace

std::vector<StepTime> step_times(const TimingsStore& timings, const Summary& summary) {
  std::set<std::tuple<std::string, std::string, std::string>> included;
  for (const SummaryRow& row : summary.rows) {
    for (const SceneSummary& scene : row.scenes) {
      included.emplace(row.variant, scene.scene, row.sensor);
    }
  }
  std::map<std::string, std::vector<TimedStep>> steps;  // By variant.
  timings.for_each([&](const TimingRow& row) {
    if (included.count({row.id.variant, row.id.scene, row.id.sensor}) == 0) return;
    std::vector<TimedStep>& of_variant = steps[row.id.variant];
    const auto is_it = [&](const TimedStep& step) { return step.name == row.step; };
    auto found = std::find_if(of_variant.begin(), of_variant.end(), is_it);
    if (found == of_variant.end()) found = of_variant.insert(found, {row.step, {}});
    found->seconds.push_back(row.seconds);
  });
  std::vector<StepTime> times;
  for (const std::string& variant : variants_of(summary)) {
    for (const TimedStep& step : steps[variant]) {
      times.push_back({variant, step.name, median(step.seconds)});
    }
  }
  return times;
}

}  // namespace croon::experiments
