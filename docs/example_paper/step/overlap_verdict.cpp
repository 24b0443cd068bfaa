#include <croon/base/text.hpp>
#include <croon/stage/stage_entry.hpp>
#include <croon/stage/step.hpp>

#include "overlap_measure.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<OverlapMeasure> measure;
  double min_overlap_ratio = 0.2;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("measure", &Params::measure, R"({"type": "nearest"})", "Measures the overlap."),
      params::number("min_overlap_ratio", &Params::min_overlap_ratio, {0.0, 1.0},
                     "With a smaller overlap the pose is rejected."),
  };
  return table;
}

class OverlapVerdict final : public Step {
 public:
  explicit OverlapVerdict(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params&) { return gives(kOverlapRatio); }

  Estimate advance(Estimate estimate, Rng&) const override {
    const double ratio = params_.measure->overlap_ratio(*estimate.target, *estimate.source,
                                                        estimate.T_target_source);
    estimate.extras.put(kOverlapRatio, ratio);
    estimate.diagnostics = {{"overlap_ratio", ratio}};
    if (ratio < params_.min_overlap_ratio) {
      estimate.rejection = "the overlap is " + fixed_number(100.0 * ratio, 0) + " %";
    }
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry overlap_verdict() {
  return stage_entry<OverlapVerdict>("overlap_verdict",
                                     "Rejects a pose at which the clouds overlap little.",
                                     "an example", table());
}

}  // namespace croon::stages::step
