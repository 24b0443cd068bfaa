#include "framework/pipeline/step_options.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::step {
namespace {

struct Params : NearestCostOptions {
  params::Slot<YawSearch> search;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("search", &Params::search, R"({"type": "binary"})",
                       "Finds the yaw of least cost."),
      }
          .inherit(nearest_cost_table());
  return table;
}

class YawAlignment final : public Step {
 public:
  explicit YawAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const NearestDistanceCost cost = nearest_cost(estimate, params_);
    const RigidTransform start = estimate.T_target_source;
    const Eigen::Vector3d up = estimate.up();
    const auto turned = [&](double yaw_rad) {
      return RigidTransform{rotation_exp(yaw_rad * up) * start.rotation, start.translation};
    };
    const YawMinimum minimum =
        params_.search->minimise([&](double yaw_rad) { return cost(turned(yaw_rad)); });
    estimate.T_target_source = turned(minimum.yaw_rad);
    estimate.diagnostics = {{"cost_m2", minimum.cost},
                            {"evaluations", static_cast<double>(minimum.evaluations)}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry yaw_alignment() {
  return stage_entry<YawAlignment>(
      "yaw_alignment",
      "Turns the sensor about the ground's normal to the least nearest-neighbour distance: yaw.",
      "CROON (arXiv 2203.03182), rough calibration", table());
}

}  // namespace croon::stages::step
