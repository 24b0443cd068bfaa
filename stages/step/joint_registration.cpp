#include <algorithm>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/params/choice.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/joint_rivals.hpp"
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
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::choice("poses", &Params::poses,
                         {{"per_scene", Poses::per_scene}, {"common", Poses::common}},
                         "Whether a sensor has a pose in each scene of a trial, or one in all."),
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                       "Thins the clouds of the coarse passes."),
          params::numbers("coarse_distances_m", &Params::coarse_distances_m, {1e-6, 1e6},
                          "The distances of the coarse passes, before max_distances_m."),
          params::boolean("motion", &Params::motion,
                          "Whether the rig moves while it scans, with a constant velocity in each "
                          "scene; needs the channel time. Of a velocity that a step before gave, "
                          "its error is estimated, with its covariance as what is expected."),
      }
          .inherit(joint_table())
          .inherit(motion_table())
          .require([](const Params& p) { return p.motion || p.clock_offset_std_s == 0.0; },
                   "clock_offset_std_s must be 0 if motion is false: at rest no clock shows");
  return table;
}

/// The estimates that are registered together.
struct Group {
  std::vector<JointScene> scenes;
  /// Of each scene, in the order of its sources.
  std::vector<RigGroup> estimates;
  std::vector<std::string> sensors;
  JointState state;
};

bool has_times(const Cloud& cloud) { return find_channel(cloud.with_channels(), kTime) != nullptr; }

/// When the points were measured; all at once if times are not `wanted`, or without the channel
/// `time`. Another variant of an experiment may have asked for the channel.
TimedScan timed(const std::shared_ptr<const Cloud>& cloud, bool wanted, double otherwise_s) {
  if (wanted && has_times(*cloud)) return {cloud, times_s(cloud->with_channels())};
  return {cloud, std::vector<double>(cloud->points().size(), otherwise_s)};
}

class JointRegistrationStep final : public RigStep {
 public:
  explicit JointRegistrationStep(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.thinning.flow();
    if (params.motion) flow.add(params::needs_channels({kTime}));
    flow.add(gives(kMotion, kMotionCovariance));
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    const auto key_of = [&](const RigEstimate& one) {
      return RigKey{params_.poses == Poses::common ? "" : one.scene, one.target};
    };
    for_each_group(rig_groups(rig, key_of), [&](const RigGroup& group) { register_group(group); });
  }

 private:
  void register_group(const RigGroup& estimates) const {
    const Group group = group_of(estimates);
    if (group.scenes.empty()) return;
    const std::vector<JointScene> coarse = thinned(group.scenes);
    const JointRegistration result = registered(group, coarse, params_);
    const bool is_any_moving = std::any_of(group.scenes.begin(), group.scenes.end(),
                                           [](const JointScene& scene) { return scene.is_moving; });
    std::optional<JointState> every_patch;
    if (is_any_moving && params_.patch_kernel_m > 0.0) {
      JointOptions options = params_;
      options.patch_kernel_m = 0.0;
      every_patch = registered(group, coarse, options).state;
    }
    for (std::size_t s = 0; s < group.scenes.size(); ++s) {
      SceneMotion motion =
          motion_of(group.scenes[s], s, result.state, every_patch, params_, params_);
      if (params_.poses == Poses::per_scene && motion.is_in_doubt(params_)) {
        motion.leads = leads_of(group.scenes[s], coarse[s], result.state, motion, every_patch);
      }
      give(group, s, result, motion);
    }
  }

  /// How far the `state` of a scene is ahead of where other speeds lead each source.
  std::vector<std::optional<double>> leads_of(const JointScene& scene, const JointScene& coarse,
                                              const JointState& state, const SceneMotion& motion,
                                              const std::optional<JointState>& every_patch) const {
    const Eigen::Vector3d axis =
        axis_of_motion(motion, stepped(scene.removed, vector_of(state.velocities.front())));
    std::vector<JointState> starts =
        other_speeds(scene, state, axis, params_.other_speeds_mps, params_);
    if (every_patch) starts.push_back(*every_patch);
    // The clouds have met already, so the widest pass is not needed.
    JointOptions near = params_;
    near.max_distances_m = params_.coarse_distances_m;
    if (near.max_distances_m.size() > 1) near.max_distances_m.erase(near.max_distances_m.begin());
    return leads_over_rivals(scene, coarse, state, starts, params_, near);
  }

  /// The passes over the thinned scenes `coarse`, then those over all points.
  JointRegistration registered(const Group& group, const std::vector<JointScene>& coarse,
                               const JointOptions& options) const {
    JointOptions coarse_options = options;
    coarse_options.max_distances_m = params_.coarse_distances_m;
    const JointState near = register_jointly(coarse, group.state, coarse_options).state;
    return register_jointly(group.scenes, near, options);
  }

  /// The estimates that can take part; the others fail.
  Group group_of(const RigGroup& estimates) const {
    Group group;
    std::vector<std::string> scene_names;
    std::vector<std::vector<RigidTransform>> starts;
    for (RigEstimate* const one : estimates) {
      try {
        JointScene scene = scene_of(*one);
        const std::size_t s = index_of(scene_names, one->scene);
        if (s == group.scenes.size()) {
          group.scenes.push_back(scene);
          group.scenes.back().sources.clear();
          group.estimates.emplace_back();
          group.state.velocities.emplace_back();
        }
        const std::size_t k = index_of(group.sensors, one->source);
        if (k == starts.size()) starts.emplace_back();
        starts[k].push_back(one->estimate.T_target_source);
        scene.sources.front().sensor = k;
        group.scenes[s].sources.push_back(std::move(scene.sources.front()));
        group.scenes[s].is_moving = group.scenes[s].is_moving && scene.is_moving;
        group.estimates[s].push_back(one);
      } catch (const StageError& error) {
        one->failure = error.what();
      }
    }
    group.state.clock_offsets_s.assign(starts.size(), 0.0);
    for (const auto& poses : starts) group.state.T_target_sensor.push_back(common_start(poses));
    return group;
  }

  /// The scene of one estimate alone. Throws StageError if a cloud cannot be registered.
  JointScene scene_of(const RigEstimate& one) const {
    const Estimate& estimate = one.estimate;
    require_usable_clouds(estimate);
    JointScene scene;
    scene.target = timed(estimate.target, params_.motion, 0.0);
    scene.reference_s = span_of(scene.target.times_s).middle_s();
    require_near(scene.target.times_s, scene.reference_s);
    scene.sources.push_back({0, timed(estimate.source, params_.motion, scene.reference_s)});
    require_near(scene.sources.front().scan.times_s, scene.reference_s);
    scene.is_moving = params_.motion && has_times(*estimate.target) && has_times(*estimate.source);
    // A velocity that was given is removed already: what remains of it is its error.
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

  TimedScan thinned(const TimedScan& scan, double otherwise_s) const {
    return timed(shared_view(*scan.cloud, params_.thinning)->thinned, params_.motion, otherwise_s);
  }

  /// The index of `name` in `names`; a new name is appended.
  static std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return index;
  }

  /// Gives the estimates of scene `s` their poses, and clouds that stand still.
  void give(const Group& group, std::size_t s, const JointRegistration& result,
            const SceneMotion& motion) const {
    const JointScene& scene = group.scenes[s];
    std::shared_ptr<const Cloud> target;
    for (std::size_t j = 0; j < scene.sources.size(); ++j) {
      const JointScene::Source& source = scene.sources[j];
      RigEstimate& one = *group.estimates[s][j];
      if (result.correspondences[s][j] < kMinJointCorrespondences) {
        one.failure = "only " + std::to_string(result.correspondences[s][j]) + " points correspond";
        continue;
      }
      Estimate& estimate = one.estimate;
      const RigidTransform& T = result.state.T_target_sensor[source.sensor];
      const double offset_s = result.state.clock_offsets_s[source.sensor];
      estimate.set_pose(T);
      // With common poses other scenes tell what a scene's velocity is.
      const std::string rejection =
          params_.poses == Poses::common ? "" : motion.rejection(j, params_);
      if (!rejection.empty()) estimate.rejection = with_reason(estimate.rejection, rejection);
      give_motion(estimate.extras, scene.is_moving, motion);
      estimate.diagnostics = diagnostics_of(result, estimate.extras, motion, j, offset_s);
      if (!motion.is_moving && offset_s == 0.0) continue;
      if (!target) {
        target = motion.is_moving ? in_trial(scene.target, motion.velocity, scene.reference_s)
                                  : estimate.target;
      }
      const RigidTransform late = motion_over(velocity_in(T.inverse(), scene.removed), offset_s);
      estimate.take_clouds(target, in_trial(source.scan, velocity_in(T.inverse(), motion.velocity),
                                            scene.reference_s, offset_s, late));
    }
  }

  std::vector<Diagnostic> diagnostics_of(const JointRegistration& result, const Extras& extras,
                                         const SceneMotion& motion, std::size_t source,
                                         double clock_offset_s) const {
    std::vector<Diagnostic> diagnostics = velocity_diagnostics(extras.get(kMotion));
    const std::vector<Diagnostic> stds = velocity_std_diagnostics(extras.get(kMotionCovariance));
    diagnostics.insert(diagnostics.end(), stds.begin(), stds.end());
    diagnostics.insert(diagnostics.end(),
                       {{"speed_std_mps", speed_std_mps(extras.get(kMotionCovariance))},
                        {"speed_shift_std_m", motion.shift_std_m[source]},
                        {"rmse_m", result.rmse_m},
                        {"iterations", static_cast<double>(result.iterations)},
                        {"converged", result.converged ? 1.0 : 0.0}});
    if (params_.clock_offset_std_s > 0.0) {
      diagnostics.emplace_back("clock_offset_s", clock_offset_s);
    }
    if (motion.leads[source]) diagnostics.emplace_back("speed_lead", *motion.leads[source]);
    return diagnostics;
  }

  /// Gives later steps the motion. A step before may have removed a velocity that it knew: then
  /// this step estimates its error, or, if it is not asked to or there is none, leaves it as it is.
  static void give_motion(Extras& extras, bool is_estimated, const SceneMotion& motion) {
    const Twist* const removed = extras.find(kMotion);
    if (removed != nullptr && !is_estimated) return;
    extras.put(kMotion, removed == nullptr ? motion.velocity
                                           : stepped(*removed, vector_of(motion.velocity)));
    extras.put(kMotionCovariance, motion.covariance);
  }

  /// The scan as a rig at rest would have measured it, with the times of the target's clock. By the
  /// motion `late` a step before has removed too little, which took the sensor's clock for right.
  static std::shared_ptr<const Cloud> in_trial(const TimedScan& scan, const Twist& velocity,
                                               double reference_s, double clock_offset_s = 0.0,
                                               const RigidTransform& late = RigidTransform()) {
    PointCloud cloud = scan.cloud->with_channels();
    if (clock_offset_s != 0.0) {
      for (Eigen::Vector3f& p : cloud.points) p = (late * p.cast<double>().eval()).cast<float>();
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
      "Sees the whole rig: registers all sensors together with the velocity of each scene, and "
      "removes the distortion of the scans by it.",
      "Zhang and Singh, LOAM, 2014; Chen and Medioni 1992", table(), 13);
}

}  // namespace croon::stages::step
