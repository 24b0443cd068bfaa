#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
#include "verifier.hpp"

namespace croon::stages::verifier {
namespace {

struct Params {
  double max_tilt_deg = 90.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("max_tilt_deg", &Params::max_tilt_deg, {0.0, 180.0},
                     "The largest angle between the two sensors' z axes."),
  };
  return table;
}

class Tilt final : public Verifier {
 public:
  explicit Tilt(const Params& params) : params_(params) {}

  std::optional<std::string> objection(const Estimate& estimate) const override {
    const double cosine = std::clamp(estimate.T_target_source.rotation(2, 2), -1.0, 1.0);
    const bool is_within = std::acos(cosine) <= rad_from_deg(params_.max_tilt_deg);
    return is_within ? std::nullopt : std::make_optional<std::string>("the sensor is tilted");
  }

 private:
  Params params_;
};

}  // namespace

StageEntry tilt() {
  return stage_entry<Tilt>("tilt", "Objects to a sensor whose z axis is far from the reference's.",
                           "a stage of a test", table());
}

}  // namespace croon::stages::verifier
