#include <memory>

#include "framework/pipeline/point_selection.hpp"
#include "framework/spatial/nearest_distance_cost.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<YawSearch> search;
  std::string points = "non_ground";
  int max_points = 1500;
  double max_distance_m = 2.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("search", &Params::search, R"({"type": "binary"})",
                   "Finds the yaw of least cost."),
      params::choice("points", &Params::points, kPointChoices,
                     "Which points the cost looks at; ground says nothing of yaw."),
      params::integer("max_points", &Params::max_points, {10, 1e9},
                      "At most so many points of the sensor are looked at, evenly spaced."),
      params::number("max_distance_m", &Params::max_distance_m, {0.01, 1e6},
                     "A nearest-neighbour distance counts for at most this."),
  };
  return table;
}

class YawAlignment final : public Step {
 public:
  explicit YawAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const SelectedClouds clouds = selected_clouds(estimate, params_.points);
    const NearestDistanceCost cost(clouds.target, *clouds.source, params_.max_points,
                                   params_.max_distance_m);
    const RigidTransform start = estimate.T_target_source;
    const Eigen::Vector3d up = estimate.up();
    const auto turned = [&](double yaw_rad) {
      return RigidTransform{rotation_exp(yaw_rad * up) * start.rotation, start.translation};
    };
    const YawMinimum minimum =
        params_.search->minimise([&](double yaw_rad) { return cost(turned(yaw_rad)); });
    estimate.T_target_source = turned(minimum.yaw_rad);
    estimate.figures = {{"cost_m2", minimum.cost},
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
