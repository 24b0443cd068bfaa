#include "framework/base/text.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "overlap.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  double min_overlap_ratio = 0.1;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("min_overlap_ratio", &Params::min_overlap_ratio, {0.0, 1.0},
                     "With a smaller overlap the pose is rejected."),
  };
  return table;
}

class OverlapCheck final : public Step {
 public:
  explicit OverlapCheck(const Params& params) : params_(params) {}

  static params::DataFlow data_flow(const Params&) { return takes(kOverlap); }

  Estimate advance(Estimate estimate, Rng&) const override {
    const double overlap_ratio = estimate.extras.get(kOverlap);
    if (overlap_ratio < params_.min_overlap_ratio) {
      estimate.rejection = "the clouds overlap by " + fixed_number(100.0 * overlap_ratio, 0) + " %";
    }
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry overlap_check() {
  return stage_entry<OverlapCheck>(
      "overlap_check", "Rejects a pose at which overlap_alignment found little overlap.", "croon",
      table());
}

}  // namespace croon::stages::step
