#include "framework/base/text.hpp"
#include "framework/pipeline/step_options.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<Icp> icp;
  PointSelection points = PointSelection::all;
  double min_inlier_ratio = 0.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("icp", &Params::icp, R"({"type": "icpn"})", "Registers the two clouds."),
      params::choice("points", &Params::points, kPointsWords, "Points that are registered."),
      params::number("min_inlier_ratio", &Params::min_inlier_ratio, {0.0, 1.0},
                     "Minimum share of the sensor's points with a correspondence (points that "
                     "`trimmed` discards have none); below it the pose is rejected."),
  };
  return table;
}

class RegistrationStep final : public Step {
 public:
  explicit RegistrationStep(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const SelectedClouds clouds = selected_clouds(estimate, params_.points);
    const Registration result =
        params_.icp->align(*clouds.target, *clouds.source, estimate.T_target_source);
    estimate.set_pose(result.T_target_source);
    estimate.information = result.information;
    if (result.inlier_ratio < params_.min_inlier_ratio) {
      estimate.rejection = "inlier ratio " + fixed_number(result.inlier_ratio, 6) + " is below " +
                           fixed_number(params_.min_inlier_ratio, 6);
    }
    estimate.diagnostics = {{"rmse_m", result.rmse_m},
                            {"inlier_ratio", result.inlier_ratio},
                            {"correspondences", static_cast<double>(result.correspondences)},
                            {"iterations", static_cast<double>(result.iterations)},
                            {"converged", result.converged ? 1.0 : 0.0}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry registration() {
  return stage_entry<RegistrationStep>(
      "registration",
      "Registers the sensor's cloud to the reference's, starting from the current pose.",
      "CROON (arXiv 2203.03182), refinement", table());
}

}  // namespace croon::stages::step
