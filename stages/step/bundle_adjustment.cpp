#include "framework/registration/bundle_adjustment.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

/// The estimates of one reference that are adjusted together.
struct RigBundle {
  std::vector<RigEstimate*> estimates;
  std::vector<std::size_t> sensors;  ///< Of each estimate, as an index into `start`.
  std::vector<BundleScene> scenes;
  std::vector<RigidTransform> start;  ///< By sensor, first the reference.
};

class BundleAdjustmentStep final : public RigStep {
 public:
  explicit BundleAdjustmentStep(BundleOptions options) : options_(std::move(options)) {}

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    std::map<std::string, std::vector<RigEstimate*>> references;
    for (RigEstimate& one : rig) {
      if (one.estimate.target->empty() || one.estimate.source->empty()) {
        one.failure = "a cloud to be adjusted is empty";
      } else {
        references[one.target].push_back(&one);
      }
    }
    for (const auto& [name, estimates] : references) adjust_rig(rig_bundle(estimates));
  }

 private:
  static RigBundle rig_bundle(const std::vector<RigEstimate*>& estimates) {
    RigBundle bundle;
    bundle.estimates = estimates;
    std::map<std::string, std::size_t> scenes, sensors;
    std::vector<std::vector<RigidTransform>> starts;
    for (const RigEstimate* const one : estimates) {
      const auto [scene, is_new_scene] = scenes.emplace(one->scene, bundle.scenes.size());
      if (is_new_scene) bundle.scenes.push_back({{0, one->estimate.target.get()}});
      const auto [sensor, is_new_sensor] = sensors.emplace(one->source, starts.size() + 1);
      if (is_new_sensor) starts.emplace_back();
      starts[sensor->second - 1].push_back(one->estimate.T_target_source);
      bundle.scenes[scene->second].push_back({sensor->second, one->estimate.source.get()});
      bundle.sensors.push_back(sensor->second);
    }
    for (BundleScene& scene : bundle.scenes) {
      std::sort(scene.begin(), scene.end(),
                [](const SensorCloud& a, const SensorCloud& b) { return a.sensor < b.sensor; });
    }
    // Scenes that went astray must not pull the start.
    constexpr PoseBounds kNear = {0.05, 0.5};
    bundle.start.emplace_back();
    for (const auto& poses : starts) {
      bundle.start.push_back(poses.size() == 1 ? poses.front() : consensus_pose(poses, kNear));
    }
    return bundle;
  }

  void adjust_rig(const RigBundle& rig) const {
    const Bundle result = adjust_bundle(rig.scenes, rig.start, options_);
    for (std::size_t i = 0; i < rig.estimates.size(); ++i) {
      RigEstimate& one = *rig.estimates[i];
      const std::size_t sensor = rig.sensors[i];
      if (result.planes[sensor] < options_.min_planes) {
        one.failure = "only " + counted(static_cast<std::size_t>(result.planes[sensor]), "plane") +
                      " are shared with another sensor";
        continue;
      }
      one.estimate.T_target_source = result.poses[sensor];
      one.estimate.information.reset();
      one.estimate.covariance = result.covariances[sensor];
      one.estimate.diagnostics = {{"scenes", static_cast<double>(rig.scenes.size())},
                                  {"planes", static_cast<double>(result.planes[sensor])},
                                  {"cost_per_plane", result.cost_per_plane},
                                  {"passes", static_cast<double>(result.passes)},
                                  {"iterations", static_cast<double>(result.iterations)},
                                  {"converged", result.converged ? 1.0 : 0.0}};
    }
  }

  BundleOptions options_;
};

}  // namespace

StageEntry bundle_adjustment() {
  return stage_entry<BundleAdjustmentStep>(
      "bundle_adjustment",
      "Sees the whole rig: gives each sensor, in all scenes of a trial, the pose at which what all "
      "sensors see lies best on common planes.",
      "Liu and Zhang, BALM, RA-L 2021; Liu, Yuan and Zhang, MLCC, T-IM 2022", bundle_table(), 2);
}

}  // namespace croon::stages::step
