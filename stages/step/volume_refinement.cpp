#include <vector>

#include "framework/pipeline/step_options.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<VolumeScorer> scorer;
  params::Slot<PoseSearch> search;
  PointSelection points = PointSelection::non_ground;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("scorer", &Params::scorer, R"({"type": "pointer_octree"})",
                   "Measures the volume that the two clouds occupy together."),
      params::slot("search", &Params::search, R"({"type": "coordinate_scan"})",
                   "Finds the pose of least volume."),
      params::choice("points", &Params::points, kPointsWords, "Which points occupy volume."),
  };
  return table;
}

class VolumeRefinement final : public Step {
 public:
  explicit VolumeRefinement(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const SelectedClouds clouds = selected_clouds(estimate, params_.points);
    const VolumeFunction volume = params_.scorer->bind(clouds.target, clouds.source);
    const double before_m3 = volume(estimate.T_target_source).m3();
    const PoseCost cost([&](const RigidTransform& pose) { return volume(pose).m3(); },
                        [&](const std::vector<RigidTransform>& poses) {
                          std::vector<double> costs;
                          for (const OccupiedVolume& v : volume.at(poses)) costs.push_back(v.m3());
                          return costs;
                        });
    const PoseMinimum minimum = params_.search->minimise(cost, estimate.T_target_source);
    estimate.T_target_source = minimum.pose;
    estimate.diagnostics = {{"volume_before_m3", before_m3},
                            {"volume_m3", minimum.cost},
                            {"evaluations", static_cast<double>(minimum.evaluations)}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry volume_refinement() {
  return stage_entry<VolumeRefinement>(
      "volume_refinement",
      "Moves the sensor to the pose at which the two clouds occupy the least volume together.",
      "CROON (arXiv 2203.03182), refinement", table());
}

}  // namespace croon::stages::step
