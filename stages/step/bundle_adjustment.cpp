#include "framework/registration/bundle_adjustment.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/velocity_numbers.hpp"

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
                         "Maximum rotation from a sensor's initial pose. A sensor beyond it is "
                         "rejected, the farthest first, and the others are adjusted without it."),
          params::number("max_correction_m", &Params::max_correction_m, {1e-6, 1e6},
                         "The same for the translation."),
      }
          .inherit(bundle_table());
  return table;
}

DofObservability all_of(Observability observability) {
  DofObservability dofs;
  dofs.fill(observability);
  return dofs;
}

/// The estimates of one reference that are adjusted together.
struct RigBundle {
  std::vector<std::size_t> sensors;   ///< Of each estimate, as an index into `start`.
  std::vector<std::size_t> scene_of;  ///< Of each estimate, as an index into `scenes`.
  std::vector<BundleScene> scenes;
  std::vector<InformedPose> start;  ///< By sensor, the reference first.
  /// By sensor: the best observability over its scenes, from the covariances of earlier steps.
  std::vector<DofObservability> start_observability;
};

class BundleAdjustmentStep final : public RigStep {
 public:
  explicit BundleAdjustmentStep(const Params& params) : params_(params) {}

  static params::DataFlow data_flow(const Params&) { return gives(kCovariance); }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    for (const RigGroup& estimates : rig_groups(rig, usable_target)) adjust_rig(estimates);
  }

 private:
  /// The target of an estimate, or std::nullopt if it was rejected. Throws StageError if its clouds
  /// or its pose are not usable.
  static std::optional<RigKey> usable_target(const RigEstimate& member) {
    if (member.estimate.rejection) return std::nullopt;
    require_usable_clouds(member.estimate);
    const RigidTransform& T = member.estimate.T_target_source;
    if (!T.rotation.allFinite() || !T.translation.allFinite()) {
      throw StageError("its pose is not finite");
    }
    return RigKey{member.target};
  }

  static RigBundle rig_bundle(const RigGroup& estimates) {
    RigBundle bundle;
    std::map<std::string, std::size_t> scenes, sensors;
    // By scene: the time that is subtracted from all of its times to keep them small.
    std::vector<double> zeros_s;
    std::vector<std::vector<const Estimate*>> starts;  // By sensor, without the reference.
    for (const RigEstimate* const member : estimates) {
      const Estimate& estimate = member->estimate;
      const auto [scene, is_new_scene] = scenes.emplace(member->scene, bundle.scenes.size());
      if (is_new_scene) {
        bundle.scenes.push_back(scene_of(estimate));
        zeros_s.push_back(zero_of_times_s(bundle.scenes.back(), *estimate.target));
        add_cloud(0, *estimate.target, zeros_s.back(), bundle.scenes.back());
      }
      const auto [sensor, is_new_sensor] = sensors.emplace(member->source, starts.size() + 1);
      if (is_new_sensor) starts.emplace_back();
      starts[sensor->second - 1].push_back(&estimate);
      bundle.sensors.push_back(sensor->second);
      bundle.scene_of.push_back(scene->second);
      add_cloud(sensor->second, *estimate.source, zeros_s[scene->second],
                bundle.scenes[scene->second]);
    }
    for (BundleScene& scene : bundle.scenes) {
      std::sort(scene.clouds.begin(), scene.clouds.end(),
                [](const SensorCloud& a, const SensorCloud& b) { return a.sensor < b.sensor; });
    }
    bundle.start.emplace_back();
    bundle.start_observability.push_back(all_of(Observability::determined));
    for (const std::vector<const Estimate*>& of_sensor : starts) {
      const RigidTransform centre = centre_of(of_sensor);
      bundle.start.push_back(start_of(of_sensor, centre));
      bundle.start_observability.push_back(start_observability_of(of_sensor, centre));
    }
    return bundle;
  }

  /// The scene of an estimate, with its motion and without clouds.
  static BundleScene scene_of(const Estimate& estimate) {
    BundleScene scene;
    const Twist* const velocity = estimate.extras.find(kMotion);
    if (velocity != nullptr) scene.velocity = *velocity;
    const Matrix6d* const motion = estimate.extras.find(kMotionCovariance);
    if (motion != nullptr) scene.motion_covariance = *motion;
    return scene;
  }

  /// The middle of the target's scan, or 0 if the scene's velocity is certain: times are not used
  /// then.
  static double zero_of_times_s(const BundleScene& scene, const Cloud& target) {
    if (scene.motion_covariance.isZero(0.0)) return 0.0;
    return span_of(times_s(target.with_channels())).middle_s();
  }

  /// The best observability of each degree of freedom over a sensor's estimates, one per scene,
  /// near `centre`.
  static DofObservability start_observability_of(const std::vector<const Estimate*>& estimates,
                                                 const RigidTransform& centre) {
    DofObservability observability = all_of(Observability::unobservable);
    for (const Estimate* const member : estimates) {
      if (!member->covariance || !agree(member->T_target_source, centre, kNearStart)) continue;
      observability = best_observability(observability, member->covariance->dofs);
    }
    return observability;
  }

  /// Adds a cloud, with its times relative to `zero_s` unless the scene's velocity is certain.
  static void add_cloud(std::size_t sensor, const Cloud& cloud, double zero_s, BundleScene& scene) {
    scene.clouds.push_back({sensor, &cloud});
    if (scene.motion_covariance.isZero(0.0)) return;
    std::vector<double>& times = scene.clouds.back().times_s;
    times = times_s(cloud.with_channels());
    for (double& time : times) time -= zero_s;
  }

  /// The pose near which the majority of a sensor's estimates lie, one per scene.
  static RigidTransform centre_of(const std::vector<const Estimate*>& estimates) {
    std::vector<RigidTransform> poses;
    for (const Estimate* const member : estimates) poses.push_back(member->T_target_source);
    return common_start(poses);
  }

  /// The initial pose of a sensor: the mean of its estimates near `centre`.
  static InformedPose start_of(const std::vector<const Estimate*>& estimates,
                               const RigidTransform& centre) {
    std::vector<InformedPose> known;
    for (const Estimate* const member : estimates) {
      if (!member->covariance) return {centre, Matrix6d::Zero()};
      if (!agree(member->T_target_source, centre, kNearStart)) continue;
      known.push_back(informed(member->T_target_source, member->covariance->matrix));
    }
    return known.empty() ? InformedPose{centre, Matrix6d::Zero()} : informed_mean(known);
  }

  void adjust_rig(const RigGroup& estimates) const {
    if (estimates.empty()) return;
    const RigBundle rig = rig_bundle(estimates);
    const Bundle result = adjust_bundle(rig.scenes, rig.start, params_);
    if (const std::optional<Far> far = farthest(rig, result)) {
      // It may have displaced correct ones.
      RigGroup others;
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
      write_result(result, rig, rig.sensors[i], rig.scene_of[i], *estimates[i]);
    }
  }

  /// A sensor that the adjustment moves too far from its initial pose.
  struct Far {
    std::size_t sensor;
    PoseError moved;
  };

  /// The sensor that exceeds its bounds by the largest factor, if any.
  std::optional<Far> farthest(const RigBundle& rig, const Bundle& result) const {
    std::optional<Far> far;
    double largest = 1.0;
    for (std::size_t k = 1; k < rig.start.size(); ++k) {
      const PoseError moved = pose_error(result.poses[k], rig.start[k].pose);
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

  void write_result(const Bundle& result, const RigBundle& rig, std::size_t sensor,
                    std::size_t scene, RigEstimate& member) const {
    const InformedPose& start = rig.start[sensor];
    const bool is_adjusted = result.planes[sensor] >= params_.min_planes;
    if (!is_adjusted && start.information.isZero(0.0)) {
      member.failure = "it shares only " +
                       counted(static_cast<std::size_t>(result.planes[sensor]), "plane") +
                       " with other sensors";
      return;
    }
    Estimate& estimate = member.estimate;
    const PoseError moved = pose_error(result.poses[sensor], estimate.T_target_source);
    estimate.set_pose(result.poses[sensor]);
    if (is_adjusted) {
      estimate.covariance = result.covariances[sensor];
      // Planes or registrations must constrain it well enough.
      const bool start_counts = params_.prior_weight > 0.0 && !start.information.isZero(0.0);
      DofObservability constrained = result.plane_observability[sensor];
      if (start_counts)
        constrained = best_observability(constrained, rig.start_observability[sensor]);
      estimate.covariance->dofs = worst_observability(estimate.covariance->dofs, constrained);
    } else {
      // All scenes share one pose, hence one covariance.
      estimate.covariance = {guarded_inverse<6>(start.information),
                             rig.start_observability[sensor]};
    }
    const std::optional<Twist>& change = result.velocities[scene];
    const double speed_change_mps = change ? change->linear_mps.norm() : 0.0;
    const auto scenes = std::count(rig.sensors.begin(), rig.sensors.end(), sensor);
    estimate.diagnostics = {{"scenes", static_cast<double>(scenes)},
                            {"planes", static_cast<double>(result.planes[sensor])},
                            {"moved_deg", deg_from_rad(moved.rotation_rad)},
                            {"moved_m", moved.translation_m},
                            {"speed_change_mps", speed_change_mps},
                            {"cost_per_plane", result.cost_per_plane},
                            {"passes", static_cast<double>(result.passes)},
                            {"iterations", static_cast<double>(result.iterations)},
                            {"converged", result.converged ? 1.0 : 0.0}};
    if (const Twist* const removed = estimate.extras.find(kMotion)) {
      const std::vector<Diagnostic> of_velocity =
          velocity_diagnostics(change ? stepped(*removed, vector_of(*change)) : *removed);
      estimate.diagnostics.insert(estimate.diagnostics.end(), of_velocity.begin(),
                                  of_velocity.end());
    }
    if (params_.clock_offset_std_s > 0.0) {
      estimate.diagnostics.emplace_back("clock_offset_s", result.clock_offsets_s[sensor]);
      estimate.diagnostics.emplace_back("clock_offset_std_s", result.clock_offset_stds_s[sensor]);
    }
  }

  Params params_;
};

}  // namespace

StageEntry bundle_adjustment() {
  return stage_entry<BundleAdjustmentStep>(
      "bundle_adjustment",
      "Processes the whole rig: sets each sensor, in all scenes of a trial, to the pose at which "
      "the points of all sensors fit common planes best. Rejected poses are ignored.",
      "Liu and Zhang, BALM, RA-L 2021; Liu, Yuan and Zhang, MLCC, T-IM 2022", table(), 13);
}

}  // namespace croon::stages::step
