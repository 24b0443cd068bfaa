#include <algorithm>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/params/choice.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/joint_rivals.hpp"
#include "framework/registration/pose_evidence.hpp"
#include "framework/registration/scene_motion.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/velocity_numbers.hpp"

namespace croon::stages::step {
namespace {

enum class Poses { per_scene, common };

struct Params : JointOptions, MotionOptions {
  Poses poses = Poses::per_scene;
  params::Slot<Preprocessor> thinning;
  std::vector<double> coarse_distances_m = {2.0, 1.0, 0.5};
  bool motion = true;
  bool needs_times = true;
  double max_free_share = 0.3;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::choice(
              "poses", &Params::poses, {{"per_scene", Poses::per_scene}, {"common", Poses::common}},
              "Whether a sensor has one pose per scene of a trial, or one in all scenes."),
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                       "Thins the clouds of the coarse passes."),
          params::numbers(
              "coarse_distances_m", &Params::coarse_distances_m, {1e-6, 1e6},
              "Maximum correspondence distances of the coarse passes, before max_distances_m."),
          params::boolean("motion", &Params::motion,
                          "Whether the rig moves while it scans, with a constant velocity in each "
                          "scene. If an earlier step supplied a velocity, "
                          "only its error is estimated, with that covariance as the prior."),
          params::boolean("needs_times", &Params::needs_times,
                          "Whether motion needs the channel time in all clouds. Otherwise the rig "
                          "is taken to be at rest in scenes with a cloud that lacks it."),
          params::number("max_free_share", &Params::max_free_share, {0.0, 1e6},
                         "Maximum ratio of the points in free space to those that agree. With one "
                         "pose per scene, a sensor that is beyond it at the initial pose does not "
                         "take part, so that it does not mislead the velocity. It is registered "
                         "afterwards, with that velocity, and rejected if it is still beyond."),
      }
          .inherit(joint_table())
          .inherit(motion_table())
          .require([](const Params& p) { return p.motion || p.clock_offset_std_s == 0.0; },
                   "clock_offset_std_s must be 0 if motion is false: a clock offset is "
                   "unobservable at rest");
  return table;
}

/// The estimates that are registered together.
struct Group {
  std::vector<JointScene> scenes;
  /// By scene, in the order of its sources.
  std::vector<RigGroup> estimates;
  std::vector<std::string> sensors;
  JointState state;
  /// Those whose initial poses are wrong, with the reasons for their rejection.
  std::vector<std::pair<RigEstimate*, std::string>> excluded;
};

bool has_times(const Cloud& cloud) { return find_channel(cloud.with_channels(), kTime) != nullptr; }

/// The scan with its measurement times, or with `default_time_s` for every point if `uses_times` is
/// false or the channel `time` is missing. The channel may be present for another variant only.
TimedScan timed(const std::shared_ptr<const Cloud>& cloud, bool uses_times, double default_time_s) {
  if (uses_times && has_times(*cloud)) return {cloud, times_s(cloud->with_channels())};
  return {cloud, std::vector<double>(cloud->points().size(), default_time_s)};
}

class JointRegistrationStep final : public RigStep {
 public:
  explicit JointRegistrationStep(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.thinning.flow();
    if (params.motion) {
      flow.add(params.needs_times ? params::needs_channels({kTime})
                                  : params::may_read_channels({kTime}));
    }
    flow.add(gives(kMotion, kMotionCovariance, kMotionInDoubt));
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    const auto key_of = [&](const RigEstimate& member) {
      return RigKey{params_.poses == Poses::common ? "" : member.scene, member.target};
    };
    for_each_group(rig_groups(rig, key_of), [&](const RigGroup& group) { register_group(group); });
  }

 private:
  void register_group(const RigGroup& estimates) const {
    const Group group = group_of(estimates);
    if (group.scenes.empty()) {
      for (const auto& [member, reason] : group.excluded) reject(member->estimate, reason);
      return;
    }
    const std::vector<JointScene> coarse = thinned(group.scenes);
    const JointRegistration result = registered(group, coarse, params_);
    const bool is_any_moving = std::any_of(group.scenes.begin(), group.scenes.end(),
                                           [](const JointScene& scene) { return scene.is_moving; });
    std::optional<JointState> state_without_patch_kernel;
    if (is_any_moving && params_.patch_kernel_m > 0.0) {
      JointOptions options = params_;
      options.patch_kernel_m = 0.0;
      state_without_patch_kernel = registered(group, coarse, options).state;
    }
    for (std::size_t s = 0; s < group.scenes.size(); ++s) {
      SceneMotion motion =
          motion_of(group.scenes[s], s, result.state, state_without_patch_kernel, params_, params_);
      if (params_.poses == Poses::per_scene && motion.is_in_doubt(params_)) {
        motion.leads =
            leads_of(group.scenes[s], coarse[s], result.state, motion, state_without_patch_kernel);
      }
      const auto still_target = write_result(group, s, result, motion);
      for (const auto& [member, reason] : group.excluded) {
        if (!register_at(motion, *member, still_target)) {
          reject(member->estimate, reason);
          store_motion(member->estimate.extras, group.scenes[s].is_moving, motion);
        }
      }
    }
  }

  /// Registers an excluded sensor with the velocity that the others determined, and returns whether
  /// its pose no longer contradicts the free space. The distortion by an unknown motion may have
  /// led the earlier steps to a wrong pose.
  bool register_at(const SceneMotion& motion, RigEstimate& member,
                   const std::shared_ptr<const Cloud>& still_target) const {
    const bool leads = std::all_of(motion.leads.begin(), motion.leads.end(), [&](const auto& lead) {
      return !lead || *lead >= params_.min_speed_lead;
    });
    if (!motion.is_moving || !leads) return false;
    const RigEstimate before = member;
    Group alone;
    alone.scenes = {scene_of(member)};
    alone.scenes.front().is_moving = false;  // The velocity is known.
    alone.estimates = {{&member}};
    alone.state = {{member.estimate.T_target_source}, {0.0}, {motion.velocity}};
    const JointRegistration result = registered(alone, thinned(alone.scenes), params_);
    SceneMotion of_source = motion;
    of_source.leads.assign(1, std::nullopt);
    const DeskewedTarget target(alone.scenes.front(), motion.velocity, params_);
    of_source.shift_std_m = shift_std_m(target, motion.covariance, result.state, params_);
    store_motion(member.estimate.extras, true, motion);
    write_result(alone, 0, result, of_source, still_target);
    if (member.failure.empty() && !contradiction(member.estimate)) return true;
    member = before;
    return false;
  }

  /// The lead of `state`, by source, over the states to which other speeds converge.
  std::vector<std::optional<double>> leads_of(
      const JointScene& scene, const JointScene& coarse, const JointState& state,
      const SceneMotion& motion,
      const std::optional<JointState>& state_without_patch_kernel) const {
    const Eigen::Vector3d axis =
        axis_of_motion(motion, stepped(scene.removed, vector_of(state.velocities.front())));
    std::vector<JointState> starts =
        other_speeds(scene, state, axis, params_.other_speeds_mps, params_);
    if (state_without_patch_kernel) starts.push_back(*state_without_patch_kernel);
    // The clouds are already aligned, so the first coarse pass is not needed.
    JointOptions near = params_;
    near.max_distances_m = params_.coarse_distances_m;
    if (near.max_distances_m.size() > 1) near.max_distances_m.erase(near.max_distances_m.begin());
    // Few points show to which state a speed leads; more of them then decide.
    constexpr int kFewer = 4;
    near.points = std::max(kMinJointCorrespondences, params_.points / kFewer);
    return leads_over_rivals(scene, coarse, state, starts, params_, near);
  }

  /// Registers the thinned scenes `coarse`, then all points.
  JointRegistration registered(const Group& group, const std::vector<JointScene>& coarse,
                               const JointOptions& options) const {
    JointOptions coarse_options = options;
    coarse_options.max_distances_m = params_.coarse_distances_m;
    const JointState near = register_jointly(coarse, group.state, coarse_options).state;
    return register_jointly(group.scenes, near, options);
  }

  /// Why the pose is wrong, if it contradicts the free space of its clouds.
  std::optional<std::string> contradiction(const Estimate& estimate) const {
    const PoseEvidence evidence =
        pose_evidence(*shared_view(*estimate.target, params_.thinning),
                      *shared_view(*estimate.source, params_.thinning), estimate.T_target_source);
    const double free = evidence.violation_ratio(), agreeing = evidence.overlap_ratio();
    if (free <= params_.max_free_share * agreeing) return std::nullopt;
    return "at the initial pose, the share of points in free space is " + fixed_number(free, 3) +
           ", above " + fixed_number(params_.max_free_share, 2) + " of the " +
           fixed_number(agreeing, 3) + " that agree";
  }

  static void reject(Estimate& estimate, const std::string& reason) {
    estimate.diagnostics.clear();
    estimate.rejection = with_reason(estimate.rejection, reason);
  }

  /// Groups the usable estimates, excludes those whose poses are wrong, and marks the others as
  /// failed.
  Group group_of(const RigGroup& estimates) const {
    Group group;
    std::vector<std::string> scene_names;
    std::vector<std::vector<RigidTransform>> starts;
    for (RigEstimate* const member : estimates) {
      try {
        JointScene scene = scene_of(*member);
        if (scene.is_moving && params_.poses == Poses::per_scene) {
          if (const auto reason = contradiction(member->estimate)) {
            group.excluded.emplace_back(member, *reason);
            continue;
          }
        }
        const std::size_t s = index_of(scene_names, member->scene);
        if (s == group.scenes.size()) {
          group.scenes.push_back(scene);
          group.scenes.back().sources.clear();
          group.estimates.emplace_back();
          group.state.velocities.emplace_back();
        }
        const std::size_t k = index_of(group.sensors, member->source);
        if (k == starts.size()) starts.emplace_back();
        starts[k].push_back(member->estimate.T_target_source);
        scene.sources.front().sensor = k;
        group.scenes[s].sources.push_back(std::move(scene.sources.front()));
        group.scenes[s].is_moving = group.scenes[s].is_moving && scene.is_moving;
        group.estimates[s].push_back(member);
      } catch (const StageError& error) {
        member->failure = error.what();
      }
    }
    group.state.clock_offsets_s.assign(starts.size(), 0.0);
    for (const auto& poses : starts) group.state.T_target_sensor.push_back(common_start(poses));
    return group;
  }

  /// The scene of one estimate alone. Throws StageError if a cloud cannot be registered.
  JointScene scene_of(const RigEstimate& member) const {
    const Estimate& estimate = member.estimate;
    require_usable_clouds(estimate);
    JointScene scene;
    scene.target = timed(estimate.target, params_.motion, 0.0);
    scene.reference_s = span_of(scene.target.times_s).middle_s();
    require_near(scene.target.times_s, scene.reference_s);
    scene.sources.push_back({0, timed(estimate.source, params_.motion, scene.reference_s)});
    require_near(scene.sources.front().scan.times_s, scene.reference_s);
    scene.is_moving = params_.motion && has_times(*estimate.target) && has_times(*estimate.source);
    // An earlier step has already removed this velocity; only its error remains.
    if (const Twist* const removed = estimate.extras.find(kMotion)) scene.removed = *removed;
    if (const Matrix6d* const error = estimate.extras.find(kMotionCovariance)) {
      scene.velocity_covariance = *error;
      scene.is_moving = scene.is_moving && !error->isZero(0.0);
    }
    return scene;
  }

  std::vector<JointScene> thinned(std::vector<JointScene> scenes) const {
    for (JointScene& scene : scenes) {
      scene.target = thinned(scene.target, scene.reference_s);
      for (auto& source : scene.sources) source.scan = thinned(source.scan, scene.reference_s);
    }
    return scenes;
  }

  TimedScan thinned(const TimedScan& scan, double default_time_s) const {
    return timed(shared_view(*scan.cloud, params_.thinning)->thinned, params_.motion,
                 default_time_s);
  }

  /// The index of `name` in `names`; a new name is appended.
  static std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return index;
  }

  /// Writes the poses and deskewed clouds to the estimates of scene `s`, and returns the deskewed
  /// target, which may be given as `target`; null if no cloud was deskewed.
  std::shared_ptr<const Cloud> write_result(const Group& group, std::size_t s,
                                            const JointRegistration& result,
                                            const SceneMotion& motion,
                                            std::shared_ptr<const Cloud> target = nullptr) const {
    const JointScene& scene = group.scenes[s];
    for (std::size_t j = 0; j < scene.sources.size(); ++j) {
      const JointScene::Source& source = scene.sources[j];
      RigEstimate& member = *group.estimates[s][j];
      if (result.correspondences[s][j] < kMinJointCorrespondences) {
        member.failure =
            "only " + std::to_string(result.correspondences[s][j]) + " points correspond";
        continue;
      }
      Estimate& estimate = member.estimate;
      const RigidTransform& T = result.state.T_target_sensor[source.sensor];
      const double offset_s = result.state.clock_offsets_s[source.sensor];
      estimate.set_pose(T);
      // With common poses, the other scenes determine the velocity of a scene.
      const std::string rejection =
          params_.poses == Poses::common ? "" : motion.rejection(j, params_);
      if (!rejection.empty()) {
        estimate.rejection = with_reason(estimate.rejection, rejection);
        estimate.extras.put(kMotionInDoubt, true);
      }
      store_motion(estimate.extras, scene.is_moving, motion);
      estimate.diagnostics = diagnostics_of(result, estimate.extras, motion, j, offset_s);
      if (!motion.is_moving && offset_s == 0.0) continue;
      if (!target) {
        target = motion.is_moving
                     ? deskewed_for_trial(scene.target, motion.velocity, scene.reference_s)
                     : estimate.target;
      }
      const RigidTransform clock_correction =
          motion_over(velocity_in(T.inverse(), scene.removed), offset_s);
      estimate.take_clouds(
          target, deskewed_for_trial(source.scan, velocity_in(T.inverse(), motion.velocity),
                                     scene.reference_s, offset_s, clock_correction));
    }
    return target;
  }

  std::vector<Diagnostic> diagnostics_of(const JointRegistration& result, const Extras& extras,
                                         const SceneMotion& motion, std::size_t source,
                                         double clock_offset_s) const {
    std::vector<Diagnostic> diagnostics;
    if (const Twist* const velocity = extras.find(kMotion)) {
      const Matrix6d& covariance = extras.get(kMotionCovariance);
      diagnostics = velocity_diagnostics(*velocity);
      const std::vector<Diagnostic> stds = velocity_std_diagnostics(covariance);
      diagnostics.insert(diagnostics.end(), stds.begin(), stds.end());
      diagnostics.insert(diagnostics.end(), {{"speed_std_mps", speed_std_mps(covariance)},
                                             {"speed_shift_std_m", motion.shift_std_m[source]}});
    }
    diagnostics.insert(diagnostics.end(), {{"rmse_m", result.rmse_m},
                                           {"iterations", static_cast<double>(result.iterations)},
                                           {"converged", result.converged ? 1.0 : 0.0}});
    if (params_.clock_offset_std_s > 0.0) {
      diagnostics.emplace_back("clock_offset_s", clock_offset_s);
    }
    if (motion.leads[source]) diagnostics.emplace_back("speed_lead", *motion.leads[source]);
    return diagnostics;
  }

  /// Stores the motion for later steps. If an earlier step removed a known velocity, the estimated
  /// error is added to it; it stays unchanged unless the motion was estimated.
  static void store_motion(Extras& extras, bool is_estimated, const SceneMotion& motion) {
    if (!is_estimated) return;
    const Twist* const removed = extras.find(kMotion);
    extras.put(kMotion, removed == nullptr ? motion.velocity
                                           : stepped(*removed, vector_of(motion.velocity)));
    extras.put(kMotionCovariance, motion.covariance);
  }

  /// The scan as a rig at rest would have measured it, with times in the target's clock.
  /// `clock_correction` is the motion that an earlier step failed to remove because it ignored the
  /// clock offset.
  static std::shared_ptr<const Cloud> deskewed_for_trial(
      const TimedScan& scan, const Twist& velocity, double reference_s, double clock_offset_s = 0.0,
      const RigidTransform& clock_correction = RigidTransform()) {
    PointCloud cloud = scan.cloud->with_channels();
    if (clock_offset_s != 0.0) {
      for (Eigen::Vector3f& p : cloud.points)
        p = (clock_correction * p.cast<double>().eval()).cast<float>();
    }
    PointCloud still =
        deskewed(std::move(cloud), scan.times_s, velocity, reference_s - clock_offset_s);
    if (clock_offset_s != 0.0 && has_times(*scan.cloud)) {
      std::vector<double> times = scan.times_s;
      for (double& time_s : times) time_s += clock_offset_s;
      set_channel(still, make_channel(kTime, times));
    }
    return scan.cloud->derived_in_trial(std::move(still), "still");
  }

  Params params_;
};

}  // namespace

StageEntry joint_registration() {
  return stage_entry<JointRegistrationStep>(
      "joint_registration",
      "Processes the whole rig: registers all sensors together with the velocity of each scene, "
      "and removes the resulting distortion from the scans.",
      "Zhang and Singh, LOAM, 2014; Chen and Medioni 1992", table(), 16);
}

}  // namespace croon::stages::step
