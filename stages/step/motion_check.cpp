#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/joint_rivals.hpp"
#include "framework/registration/scene_motion.hpp"
#include "framework/registration/sweep_times.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/times.hpp"

namespace croon::stages::step {
namespace {

struct Params : JointOptions, MotionOptions {
  Params() {
    max_distances_m = {1.0, 0.5, 0.3};
    points = 2000;
  }
  params::Slot<Preprocessor> thinning;
  double period_s = 0.1;
  double max_travel_m = 0.15;
  double max_travel_apart_m = 0.02;
  double max_turn_deg = 1.0;
  double max_shift_m = 0.05;
  double max_shift_std_m = 0.005;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                       "Thins the clouds that are registered."),
          params::number(
              "period_s", &Params::period_s, {1e-3, 10.0},
              "Assumed duration of one revolution. Only its product with the velocity matters."),
          params::number("max_travel_m", &Params::max_travel_m, {0.0, 1e6},
                         "Maximum distance that the rig travels during one revolution, less three "
                         "standard deviations. It shifts poses by up to half as much."),
          params::number("max_travel_apart_m", &Params::max_travel_apart_m, {0.0, 1e6},
                         "The same if the clocks of the sensors differ: scans that are a second "
                         "apart differ by ten times as much."),
          params::number("max_turn_deg", &Params::max_turn_deg, {0.0, 180.0},
                         "Maximum angle that the rig turns during one revolution, less three "
                         "standard deviations."),
          params::number("max_shift_m", &Params::max_shift_m, {0.0, 1e6},
                         "Maximum distance between the pose and the pose from a registration that "
                         "models motion."),
          params::number(
              "max_shift_std_m", &Params::max_shift_std_m, {0.0, 1e6},
              "If velocity uncertainty shifts a sensor by more than this, an earlier step rejected "
              "a sensor, or the rig appears to travel by more than 0.03 m and three standard "
              "deviations, the registration is compared with those from other_speeds_mps."),
      }
          .inherit(joint_table())
          .inherit(motion_table());
  return table;
}

/// Apparent travel during one revolution below this is normal for a rig at rest.
constexpr double kMinDoubtfulTravel_m = 0.03;

/// The length of `vector` less three standard deviations along it.
double certain_length(const Eigen::Vector3d& vector, const Eigen::Matrix3d& covariance) {
  const double length = vector.norm();
  if (length == 0.0) return 0.0;
  const Eigen::Vector3d direction = vector / length;
  return length - 3.0 * std::sqrt(direction.dot(covariance * direction));
}

class MotionCheck final : public RigStep {
 public:
  explicit MotionCheck(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) { return params.thinning.flow(); }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    const auto key_of = [](const RigEstimate& member) {
      require_usable_clouds(member.estimate);
      return RigKey{member.scene, member.target};
    };
    for_each_group(rig_groups(rig, key_of), [&](const RigGroup& scene) { check(scene); });
  }

 private:
  /// Rejects the poses of one scene if its clouds show motion, unless an earlier step knows it.
  /// Rejected sensors take part too: motion is most visible to sensors that face the direction of
  /// travel.
  void check(const RigGroup& estimates) const {
    const auto is_checked = [](const RigEstimate* member) {
      return !member->estimate.rejection && member->estimate.extras.find(kMotion) == nullptr;
    };
    if (std::any_of(estimates.begin(), estimates.end(), is_checked)) reject_if_moving(estimates);
  }

  void reject_if_moving(const std::vector<RigEstimate*>& estimates) const {
    const JointScene scene = scene_of(estimates);
    const JointState state = register_jointly({scene}, start_of(estimates), params_).state;
    SceneMotion motion = motion_of(scene, 0, state, std::nullopt, params_, params_);
    const Twist& velocity = state.velocities.front();
    const double travel_m = params_.period_s * velocity.linear_mps.norm();
    const double turn_deg = deg_from_rad(params_.period_s * velocity.angular_radps.norm());
    const bool are_clocks_apart =
        std::any_of(estimates.begin(), estimates.end(), [](const RigEstimate* member) {
          const TimesInDoubt* const doubt = member->estimate.extras.find(kTimesInDoubt);
          return doubt != nullptr && doubt->are_clocks_apart;
        });
    const bool is_moving =
        motion.is_moving &&
        is_too_fast(velocity, motion.covariance,
                    are_clocks_apart ? params_.max_travel_apart_m : params_.max_travel_m);
    const double shift_std_m =
        *std::max_element(motion.shift_std_m.begin(), motion.shift_std_m.end());
    const bool appears_to_travel =
        travel_m > kMinDoubtfulTravel_m &&
        certain_length(velocity.linear_mps, motion.covariance.bottomRightCorner<3, 3>()) > 0.0;
    // Uncorrected motion is a common reason for a rejection by an earlier step.
    const bool is_any_rejected = std::any_of(
        estimates.begin(), estimates.end(),
        [](const RigEstimate* estimate) { return estimate->estimate.rejection.has_value(); });
    if (!is_moving &&
        (appears_to_travel || is_any_rejected || shift_std_m > params_.max_shift_std_m))
      motion.leads = leads_of(scene, state, motion);
    for (std::size_t j = 0; j < estimates.size(); ++j) {
      Estimate& estimate = estimates[j]->estimate;
      const double shift_m =
          (state.T_target_sensor[j].translation - estimate.T_target_source.translation).norm();
      estimate.diagnostics = {{"travel_m", travel_m},
                              {"turn_deg", turn_deg},
                              {"speed_std_mps", speed_std_mps(motion.covariance)},
                              {"shift_m", shift_m},
                              {"shift_std_m", motion.shift_std_m[j]}};
      if (motion.leads[j]) estimate.diagnostics.emplace_back("speed_lead", *motion.leads[j]);
      std::string reason = motion.rejection(j, params_);
      if (is_moving) {
        reason = "motion during the scans explains the clouds better than a rig at rest: " +
                 fixed_number(travel_m, 2) + " m and " + fixed_number(turn_deg, 2) +
                 " deg per revolution, and without usable times it cannot be corrected";
      } else if (!reason.empty()) {
        reason = "motion during the scans cannot be excluded: " + reason;
      } else if (shift_m > params_.max_shift_m) {
        reason = "a registration that takes motion into account moves the pose by " +
                 fixed_number(shift_m, 2) + " m, above " + fixed_number(params_.max_shift_m, 2);
      }
      if (!reason.empty()) estimate.rejection = with_reason(estimate.rejection, reason);
    }
  }

  bool is_too_fast(const Twist& velocity, const Matrix6d& covariance, double max_travel_m) const {
    const double travel_m = params_.period_s * certain_length(velocity.linear_mps,
                                                              covariance.bottomRightCorner<3, 3>());
    const double turn_rad =
        params_.period_s * certain_length(velocity.angular_radps, covariance.topLeftCorner<3, 3>());
    return travel_m > max_travel_m || deg_from_rad(turn_rad) > params_.max_turn_deg;
  }

  /// The clouds, with the times of scans of one period that start simultaneously.
  JointScene scene_of(const std::vector<RigEstimate*>& estimates) const {
    JointScene scene;
    scene.is_moving = true;
    scene.reference_s = 0.5 * params_.period_s;
    scene.target = swept(*estimates.front()->estimate.target);
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      scene.sources.push_back({k, swept(*estimates[k]->estimate.source)});
    }
    return scene;
  }

  TimedScan swept(const Cloud& cloud) const {
    const std::shared_ptr<const Cloud>& thinned = shared_view(cloud, params_.thinning)->thinned;
    const Points& points = thinned->points();
    return {thinned, sweep_times_s(points, sweep_of(points), params_.period_s)};
  }

  /// The rig at rest, at its current poses.
  static JointState start_of(const std::vector<RigEstimate*>& estimates) {
    JointState start;
    for (const RigEstimate* const member : estimates) {
      start.T_target_sensor.push_back(member->estimate.T_target_source);
    }
    start.clock_offsets_s.assign(estimates.size(), 0.0);
    start.velocities.emplace_back();
    return start;
  }

  /// The lead of `state`, by source, over the states to which other speeds converge.
  std::vector<std::optional<double>> leads_of(const JointScene& scene, const JointState& state,
                                              const SceneMotion& motion) const {
    const Eigen::Vector3d axis = axis_of_motion(motion, state.velocities.front());
    JointOptions near = params_, fine = params_;
    fine.max_distances_m = {params_.max_distances_m.back()};
    near.max_distances_m = params_.max_distances_m.size() > 1
                               ? std::vector<double>{*(params_.max_distances_m.end() - 2)}
                               : params_.max_distances_m;
    return leads_over_rivals(scene, scene, state,
                             other_speeds(scene, state, axis, params_.other_speeds_mps, params_),
                             fine, near);
  }

  Params params_;
};

}  // namespace

StageEntry motion_check() {
  return stage_entry<MotionCheck>(
      "motion_check",
      "Processes the whole rig: rejects the poses of a scene if uncorrected motion during its "
      "scans explains the clouds better than a rig at rest, or cannot be excluded. Needs no times: "
      "each sensor is assumed to sweep about its z axis.",
      "croon", table(), 5);
}

}  // namespace croon::stages::step
