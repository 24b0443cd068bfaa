#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/params/choice.hpp"
#include "framework/pipeline/shared_view.hpp"
#include "framework/registration/joint_uncertainty.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

enum class Poses { per_scene, common };

struct Params : JointOptions {
  Poses poses = Poses::per_scene;
  params::Slot<Preprocessor> thinning;
  std::vector<double> coarse_distances_m = {2.0, 1.0, 0.5};
  bool motion = true;
  double min_motion = 100.0;
  double max_speed_std_mps = 0.25;
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
                          "scene; needs the channel time."),
          params::number("min_motion", &Params::min_motion, {0.0, 1e9},
                         "A scene stands still if its velocity's squared distance from zero, in "
                         "standard deviations, is below; that of standing cars was 6 to 67 on "
                         "tuning scenes."),
          params::number("max_speed_std_mps", &Params::max_speed_std_mps, {0.0, 1e6},
                         "With a pose per scene, a scene is rejected if its speed along x and y of "
                         "the reference is less certain: what moves by itself cannot be told "
                         "from what stands."),
      }
          .inherit(joint_table());
  return table;
}

/// The estimates that are registered together.
struct Group {
  std::vector<JointScene> scenes;
  std::vector<std::vector<RigEstimate*>>
      estimates;  ///< Of each scene, in the order of its sources.
  std::vector<std::string> sensors;
  JointState state;
};

bool has_times(const Cloud& cloud) { return find_channel(cloud.with_channels(), kTime) != nullptr; }

/// When the points were measured; without the channel `time` all at once.
TimedScan timed(const std::shared_ptr<const Cloud>& cloud, double otherwise_s) {
  if (has_times(*cloud)) return {cloud, times_s(cloud->with_channels())};
  return {cloud, std::vector<double>(cloud->points().size(), otherwise_s)};
}

class JointRegistrationStep final : public RigStep {
 public:
  explicit JointRegistrationStep(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.thinning.flow();
    if (params.motion) flow.add(params::needs_channels({kTime}));
    flow.gives.push_back(kMotion.doc());
    flow.gives.push_back(kMotionCovariance.doc());
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    std::map<std::pair<std::string, std::string>, std::vector<RigEstimate*>> groups;
    for (RigEstimate& one : rig) {
      const std::string scene = params_.poses == Poses::common ? "" : one.scene;
      groups[{scene, one.target}].push_back(&one);
    }
    for (const auto& [name, estimates] : groups) register_group(estimates);
  }

 private:
  void register_group(const std::vector<RigEstimate*>& estimates) const {
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
      give(group, s, result, motion_of(group.scenes[s], s, result.state, every_patch));
    }
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
  Group group_of(const std::vector<RigEstimate*>& estimates) const {
    Group group;
    std::vector<std::string> scene_names;
    std::vector<std::vector<RigidTransform>> starts;
    for (RigEstimate* const one : estimates) {
      try {
        JointScene scene = scene_of(*one);
        const std::size_t s = index_of(scene_names, one->scene);
        if (s == group.scenes.size()) {
          group.scenes.push_back({scene.target, {}, scene.reference_s, scene.is_moving});
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
    if (estimate.target->empty() || estimate.source->empty()) {
      throw StageError("a cloud to be registered is empty");
    }
    JointScene scene;
    scene.target = timed(estimate.target, 0.0);
    scene.reference_s = span_of(scene.target.times_s).middle_s();
    require_near(scene.target.times_s, scene.reference_s);
    scene.sources.push_back({0, timed(estimate.source, scene.reference_s)});
    require_near(scene.sources.front().scan.times_s, scene.reference_s);
    scene.is_moving = params_.motion && has_times(*estimate.target) && has_times(*estimate.source);
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
    return timed(shared_view(*scan.cloud, params_.thinning)->thinned, otherwise_s);
  }

  /// The index of `name` in `names`; a new name is appended.
  static std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name);
    return index;
  }

  /// What is known of the motion of a scene.
  struct Motion {
    Twist velocity;
    Matrix6d covariance = Matrix6d::Zero();
    bool is_moving = false;
  };

  /// The motion of scene `s` in `state`. What moves by itself may decide between two velocities:
  /// that in the state `every_patch`, in which no patch loses weight, is then another, and by so
  /// much the velocity is not known.
  Motion motion_of(const JointScene& scene, std::size_t s, const JointState& state,
                   const std::optional<JointState>& every_patch) const {
    Motion motion;
    if (!scene.is_moving) return motion;
    const Vector6d velocity = vector_of(state.velocities[s]);
    motion.covariance = velocity_covariance(scene, state.velocities[s], state, params_);
    if (every_patch) {
      const Vector6d apart = velocity - vector_of(every_patch->velocities[s]);
      motion.covariance += apart * apart.transpose();
    }
    motion.is_moving =
        velocity.dot(guarded_inverse<6>(motion.covariance) * velocity) >= params_.min_motion;
    if (motion.is_moving) motion.velocity = state.velocities[s];
    return motion;
  }

  void give(const Group& group, std::size_t s, const JointRegistration& result,
            const Motion& motion) const {
    const JointScene& scene = group.scenes[s];
    const double speed_std_mps = std::sqrt(motion.covariance(3, 3) + motion.covariance(4, 4));
    std::shared_ptr<const Cloud> target;
    for (std::size_t j = 0; j < scene.sources.size(); ++j) {
      Estimate& estimate = group.estimates[s][j]->estimate;
      const JointScene::Source& source = scene.sources[j];
      if (result.correspondences[s][j] < kLeastJointCorrespondences) {
        group.estimates[s][j]->failure =
            "only " + std::to_string(result.correspondences[s][j]) + " points correspond";
        continue;
      }
      estimate.diagnostics = {{"speed_mps", motion.velocity.linear_mps.norm()},
                              {"speed_std_mps", speed_std_mps},
                              {"turn_degps", deg_from_rad(motion.velocity.angular_radps.norm())},
                              {"rmse_m", result.rmse_m},
                              {"iterations", static_cast<double>(result.iterations)},
                              {"converged", result.converged ? 1.0 : 0.0}};
      if (params_.clock_offset_std_s > 0.0) {
        estimate.diagnostics.emplace_back("clock_offset_s",
                                          result.state.clock_offsets_s[source.sensor]);
      }
      if (params_.poses == Poses::per_scene && speed_std_mps > params_.max_speed_std_mps) {
        estimate.rejection = "the standard deviation of the speed, m/s, is " +
                             fixed_number(speed_std_mps, 3) + ", above " +
                             fixed_number(params_.max_speed_std_mps, 3);
      }
      give_motion(estimate.extras, scene.is_moving, motion);
      const RigidTransform& T = result.state.T_target_sensor[source.sensor];
      estimate.T_target_source = T;
      if (!motion.is_moving) continue;
      if (!target) target = still(scene.target, motion.velocity, scene.reference_s);
      estimate.target = target;
      const double offset_s = result.state.clock_offsets_s[source.sensor];
      estimate.source = still(source.scan, velocity_in(T.inverse(), motion.velocity),
                              scene.reference_s - offset_s);
    }
  }

  /// Gives later steps the motion. A step before may have removed a velocity that it knew: then
  /// this step estimates what remains of it, or, if it is not asked to, leaves it as it is.
  static void give_motion(Extras& extras, bool is_estimated, const Motion& motion) {
    const Twist* const removed = extras.find(kMotion);
    if (removed != nullptr && !is_estimated) return;
    extras.put(kMotion, removed == nullptr ? motion.velocity
                                           : stepped(*removed, vector_of(motion.velocity)));
    extras.put(kMotionCovariance, motion.covariance);
  }

  static std::shared_ptr<const Cloud> still(const TimedScan& scan, const Twist& velocity,
                                            double reference_s) {
    return deskewed(*scan.cloud, scan.times_s, velocity, reference_s);
  }

  Params params_;
};

}  // namespace

StageEntry joint_registration() {
  return stage_entry<JointRegistrationStep>(
      "joint_registration",
      "Sees the whole rig: registers all sensors together with the velocity of each scene, and "
      "removes the distortion of the scans by it.",
      "Zhang and Singh, LOAM, 2014; Chen and Medioni 1992", table(), 2);
}

}  // namespace croon::stages::step
