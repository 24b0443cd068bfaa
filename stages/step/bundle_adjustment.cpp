#include "framework/registration/bundle_adjustment.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

struct Params : BundleOptions {
  double max_correction_deg = 180.0;
  double max_correction_m = 1e6;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::number("max_correction_deg", &Params::max_correction_deg, {1e-6, 180.0},
                         "A sensor that would turn farther from its start is rejected, the "
                         "farthest first, and the others are adjusted without it."),
          params::number("max_correction_m", &Params::max_correction_m, {1e-6, 1e6},
                         "The same for a sensor that would move farther."),
      }
          .inherit(bundle_table());
  return table;
}

/// The estimates of one reference that are adjusted together.
struct RigBundle {
  std::vector<RigEstimate*> estimates;
  std::vector<std::size_t> sensors;   ///< Of each estimate, as an index into `start`.
  std::vector<std::size_t> scene_of;  ///< Of each estimate, as an index into `scenes`.
  std::vector<BundleScene> scenes;
  std::vector<BundleStart> start;  ///< By sensor, first the reference.
};

class BundleAdjustmentStep final : public RigStep {
 public:
  explicit BundleAdjustmentStep(const Params& params) : params_(params) {}

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    std::map<std::string, std::vector<RigEstimate*>> references;
    for (RigEstimate& one : rig) {
      if (one.estimate.rejection) continue;
      if (one.estimate.target->empty() || one.estimate.source->empty()) {
        one.failure = "a cloud to be adjusted is empty";
      } else {
        references[one.target].push_back(&one);
      }
    }
    for (const auto& [name, estimates] : references) adjust_rig(estimates);
  }

 private:
  static RigBundle rig_bundle(const std::vector<RigEstimate*>& estimates) {
    RigBundle bundle;
    bundle.estimates = estimates;
    std::map<std::string, std::size_t> scenes, sensors;
    std::vector<std::vector<const Estimate*>> starts;
    for (const RigEstimate* const one : estimates) {
      const auto [scene, is_new_scene] = scenes.emplace(one->scene, bundle.scenes.size());
      if (is_new_scene) bundle.scenes.push_back(scene_with_reference(one->estimate));
      const auto [sensor, is_new_sensor] = sensors.emplace(one->source, starts.size() + 1);
      if (is_new_sensor) starts.emplace_back();
      starts[sensor->second - 1].push_back(&one->estimate);
      bundle.sensors.push_back(sensor->second);
      bundle.scene_of.push_back(scene->second);
      BundleScene& present = bundle.scenes[scene->second];
      present.clouds.push_back({sensor->second, one->estimate.source.get()});
      if (!present.motion_covariance.isZero(0.0)) {
        present.clouds.back().times_s = times_after(*one->estimate.source, zero_s(one->estimate));
      }
    }
    for (BundleScene& scene : bundle.scenes) {
      std::sort(scene.clouds.begin(), scene.clouds.end(),
                [](const SensorCloud& a, const SensorCloud& b) { return a.sensor < b.sensor; });
    }
    bundle.start.emplace_back();
    for (const std::vector<const Estimate*>& of_sensor : starts) {
      bundle.start.push_back(start_of(of_sensor));
    }
    return bundle;
  }

  /// The start of a sensor that has these estimates, one per scene.
  static BundleStart start_of(const std::vector<const Estimate*>& estimates) {
    // Scenes that went astray must not pull the start.
    constexpr PoseBounds kNear = {0.05, 0.5};
    std::vector<RigidTransform> poses;
    for (const Estimate* const one : estimates) poses.push_back(one->T_target_source);
    const RigidTransform centre = poses.size() == 1 ? poses.front() : consensus_pose(poses, kNear);
    std::vector<InformedPose> informed;
    for (const Estimate* const one : estimates) {
      if (!one->covariance) return {centre, Matrix6d::Zero()};
      if (!agree(one->T_target_source, centre, kNear)) continue;
      informed.push_back({one->T_target_source, guarded_inverse<6>(one->covariance->matrix)});
    }
    if (informed.empty()) return {centre, Matrix6d::Zero()};
    const InformedPose mean = informed_mean(informed);
    return {mean.pose, mean.information};
  }

  /// The scene of an estimate, with its reference alone.
  static BundleScene scene_with_reference(const Estimate& estimate) {
    BundleScene scene;
    scene.clouds.push_back({0, estimate.target.get()});
    const Matrix6d* const motion = estimate.extras.find(kMotionCovariance);
    if (motion != nullptr && !motion->isZero(0.0)) {
      scene.motion_covariance = *motion;
      scene.clouds.front().times_s = times_after(*estimate.target, zero_s(estimate));
    }
    return scene;
  }

  /// The zero of a scene's times, so that they are small.
  static double zero_s(const Estimate& estimate) {
    return span_of(times_s(estimate.target->with_channels())).middle_s();
  }

  static std::vector<double> times_after(const Cloud& cloud, double zero_s) {
    std::vector<double> times = times_s(cloud.with_channels());
    for (double& time : times) time -= zero_s;
    return times;
  }

  void adjust_rig(const std::vector<RigEstimate*>& estimates) const {
    if (estimates.empty()) return;
    const RigBundle rig = rig_bundle(estimates);
    const Bundle result = adjust_bundle(rig.scenes, rig.start, params_);
    if (const std::optional<Far> far = farthest(rig, result)) {
      // It may have moved others that are right.
      std::vector<RigEstimate*> others;
      for (std::size_t i = 0; i < estimates.size(); ++i) {
        if (rig.sensors[i] != far->sensor) {
          others.push_back(estimates[i]);
        } else {
          reject(estimates[i]->estimate, far->moved);
        }
      }
      return adjust_rig(others);
    }
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      give(rig, result, i);
    }
  }

  /// A sensor that would move too far from its start.
  struct Far {
    std::size_t sensor;
    PoseError moved;
  };

  /// The one that exceeds its bounds by the largest factor, if one does.
  std::optional<Far> farthest(const RigBundle& rig, const Bundle& result) const {
    std::optional<Far> far;
    double largest = 1.0;
    for (std::size_t k = 1; k < rig.start.size(); ++k) {
      const PoseError moved = pose_error(result.poses[k], rig.start[k].T_common_sensor);
      const double factor = std::max(deg_from_rad(moved.rotation_rad) / params_.max_correction_deg,
                                     moved.translation_m / params_.max_correction_m);
      if (factor <= largest) continue;
      largest = factor;
      far = {k, moved};
    }
    return far;
  }

  void reject(Estimate& estimate, const PoseError& moved) const {
    const double rotation_deg = deg_from_rad(moved.rotation_rad);
    estimate.rejection = "the planes of all sensors would move it by " +
                         fixed_number(rotation_deg, 3) + " degrees and " +
                         fixed_number(moved.translation_m, 3) + " m, above " +
                         fixed_number(params_.max_correction_deg, 3) + " or " +
                         fixed_number(params_.max_correction_m, 3);
    estimate.diagnostics = {{"moved_deg", rotation_deg}, {"moved_m", moved.translation_m}};
  }

  void give(const RigBundle& rig, const Bundle& result, std::size_t i) const {
    const std::size_t sensor = rig.sensors[i], scene = rig.scene_of[i];
    RigEstimate& one = *rig.estimates[i];
    const BundleStart& start = rig.start[sensor];
    const bool is_adjusted = result.planes[sensor] >= params_.min_planes;
    if (!is_adjusted && start.information.isZero(0.0)) {
      one.failure = "only " + counted(static_cast<std::size_t>(result.planes[sensor]), "plane") +
                    " are shared with another sensor";
      return;
    }
    Estimate& estimate = one.estimate;
    const PoseError moved = pose_error(result.poses[sensor], estimate.T_target_source);
    estimate.T_target_source = result.poses[sensor];
    estimate.information.reset();
    if (is_adjusted) {
      estimate.covariance = result.covariances[sensor];
    } else {
      estimate.covariance->matrix = guarded_inverse<6>(start.information);
    }
    const std::optional<Twist>& velocity = result.velocities[scene];
    const double speed_change_mps = velocity ? velocity->linear_mps.norm() : 0.0;
    estimate.diagnostics = {{"scenes", static_cast<double>(result.velocities.size())},
                            {"planes", static_cast<double>(result.planes[sensor])},
                            {"moved_deg", deg_from_rad(moved.rotation_rad)},
                            {"moved_m", moved.translation_m},
                            {"speed_change_mps", speed_change_mps},
                            {"cost_per_plane", result.cost_per_plane},
                            {"passes", static_cast<double>(result.passes)},
                            {"iterations", static_cast<double>(result.iterations)},
                            {"converged", result.converged ? 1.0 : 0.0}};
  }

  Params params_;
};

}  // namespace

StageEntry bundle_adjustment() {
  return stage_entry<BundleAdjustmentStep>(
      "bundle_adjustment",
      "Sees the whole rig: gives each sensor, in all scenes of a trial, the pose at which what all "
      "sensors see lies best on common planes. Rejected poses take no part.",
      "Liu and Zhang, BALM, RA-L 2021; Liu, Yuan and Zhang, MLCC, T-IM 2022", table(), 3);
}

}  // namespace croon::stages::step
