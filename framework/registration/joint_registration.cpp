#include "framework/registration/joint_registration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "framework/base/threads.hpp"
#include "framework/registration/block_system.hpp"
#include "framework/registration/clock_offset.hpp"
#include "framework/registration/joint_pair.hpp"

namespace croon {
namespace {

class JointProblem {
 public:
  JointProblem(const std::vector<JointScene>& scenes, const JointOptions& options,
               std::size_t sensors)
      : scenes_(scenes), options_(options) {
    for (std::size_t k = 0; k < sensors; ++k) poses_.push_back(appended_block(6, unknowns_));
    for (const JointScene& scene : scenes) {
      velocities_.push_back(appended_block(scene.is_moving ? 6 : 0, unknowns_));
    }
    for (std::size_t k = 0; k < sensors; ++k) {
      offsets_.push_back(appended_block(options.clock_offset_std_s > 0.0 ? 1 : 0, unknowns_));
    }
  }

  /// The targets of all scenes at `state`.
  std::vector<DeskewedTarget> targets_at(const JointState& state) const {
    std::vector<DeskewedTarget> targets;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      targets.emplace_back(scenes_[s], state.velocities[s], options_);
    }
    return targets;
  }

  /// Moves `outcome` by Gauss-Newton at one distance until convergence.
  void run(JointRegistration& outcome, std::vector<DeskewedTarget>& targets,
           double max_distance_m) const {
    const bool is_last = max_distance_m == options_.max_distances_m.back();
    const double max_deviations =
        is_last ? options_.step_tolerance.back() : options_.step_tolerance.front();
    outcome.converged = false;
    Eigen::VectorXd last = Eigen::VectorXd::Zero(unknowns_);
    std::vector<Eigen::VectorXd> steps;
    for (int i = 0; i < options_.max_iterations && !outcome.converged; ++i) {
      auto [step, in_deviations] = step_at(outcome, targets, max_distance_m);
      const double factor = steps_ahead(last, step);
      last = factor > 1.0 ? Eigen::VectorXd::Zero(unknowns_) : step;
      step *= factor;
      steps.push_back(step);
      outcome.converged = in_deviations < max_deviations || is_small(step, max_distance_m) ||
                          lead_back(steps, max_distance_m);
      move(outcome.state, step);
      ++outcome.iterations;
    }
  }

 private:
  struct Step {
    Eigen::VectorXd vector;
    /// Its length in standard deviations of the unknowns, if residuals were independent: the
    /// Newton decrement (Boyd and Vandenberghe, Convex Optimization, section 9.5.1).
    double in_deviations;
  };

  Step step_at(JointRegistration& outcome, std::vector<DeskewedTarget>& targets,
               double max_distance_m) const {
    // A tree whose points have moved by less finds about the same neighbours; residuals use the
    // exact positions.
    constexpr double kShiftShare = 0.04;
    std::vector<std::vector<PairEquations>> pairs(scenes_.size());
    for_each_in_parallel(scenes_.size(), [&](std::size_t s) {
      const JointScene& scene = scenes_[s];
      const Twist& velocity = outcome.state.velocities[s];
      DeskewedTarget& target = targets[s];
      target.set_velocity(velocity, kShiftShare * max_distance_m);
      pairs[s].resize(scene.sources.size());
      for_each_in_parallel(scene.sources.size(), [&](std::size_t j) {
        pairs[s][j] = pair_equations(scene.sources[j], target,
                                     {outcome.state, velocity, max_distance_m, options_});
      });
    });
    BlockSystem system = BlockSystem::zero(unknowns_);
    double square_sum = 0.0, weight_sum = 0.0;
    outcome.correspondences.assign(scenes_.size(), {});
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      for (std::size_t j = 0; j < pairs[s].size(); ++j) {
        const PairEquations& pair = pairs[s][j];
        outcome.correspondences[s].push_back(pair.correspondences);
        if (pair.correspondences < kMinJointCorrespondences) continue;
        const std::size_t k = scenes_[s].sources[j].sensor;
        system.add<3>({poses_[k], velocities_[s], offsets_[k]},
                      {kPairPose, kPairVelocity, kPairOffset}, pair.gradient, pair.information);
        square_sum += pair.weighted_square_sum;
        weight_sum += pair.weight_sum;
      }
    }
    outcome.rmse_m = weight_sum > 0.0 ? std::sqrt(square_sum / weight_sum) : 0.0;
    add_priors(outcome.state, system);
    Step step = {-system.hessian.ldlt().solve(system.gradient), 0.0};
    step.in_deviations =
        std::sqrt(std::max(0.0, -step.vector.dot(system.gradient))) / outcome.rmse_m;
    return step;
  }

  /// Adds the priors of velocities and offsets, as residuals of the kernel's width, and a damping,
  /// so that a pose stays in unconstrained directions.
  void add_priors(const JointState& state, BlockSystem& system) const {
    constexpr double kDamping = 1e-6;
    system.hessian.diagonal() *= 1.0 + kDamping;
    system.hessian.diagonal().array() += 1e-12;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const Block& velocity = velocities_[s];
      if (!velocity) continue;
      const Matrix6d information = velocity_information(scenes_[s], options_);
      system.add(velocity, velocity, information);
      system.add(velocity, information * vector_of(state.velocities[s]));
    }
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
      if (!offsets_[k]) continue;
      const Eigen::Index at = offsets_[k].at;
      const double share = options_.kernel_width_m / options_.clock_offset_std_s;
      system.hessian(at, at) += share * share;
      system.gradient(at) += share * share * state.clock_offsets_s[k];
    }
  }

  /// The sum of the steps that are to be expected if they go on to shrink by the same ratio as from
  /// `last` to `step`, in units of `step`; 1 if their directions differ. In weakly constrained
  /// directions, correspondences make the steps too short (the accelerated ICP of Besl and McKay,
  /// PAMI 1992).
  double steps_ahead(const Eigen::VectorXd& last, const Eigen::VectorXd& step) const {
    constexpr double kMinCosine = 0.95, kMaxRatio = 0.85;
    const double length_m = in_metres(step).norm(), last_m = in_metres(last).norm();
    if (length_m == 0.0 || last_m == 0.0) return 1.0;
    const double cosine = in_metres(step).dot(in_metres(last)) / (length_m * last_m);
    if (cosine < kMinCosine) return 1.0;
    return 1.0 / (1.0 - std::min(kMaxRatio, length_m / last_m));
  }

  /// The elements of a step as motions of a point at a range of 10 m, at the ends of a scan.
  Eigen::VectorXd in_metres(Eigen::VectorXd step) const {
    constexpr double kRange_m = 10.0, kHalfScan_s = 0.05;
    for (const Block& pose : poses_) step.segment<3>(pose.at) *= kRange_m;
    for (const Block& velocity : velocities_) {
      if (!velocity) continue;
      step.segment<3>(velocity.at) *= kRange_m * kHalfScan_s;
      step.segment<3>(velocity.at + 3) *= kHalfScan_s;
    }
    for (const Block& offset : offsets_) {
      if (offset) step(offset.at) *= kRange_m;
    }
    return step;
  }

  void move(JointState& state, const Eigen::VectorXd& step) const {
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      RigidTransform& T = state.T_target_sensor[k];
      T = stepped(T, step.segment<6>(poses_[k].at));
      if (offsets_[k]) state.clock_offsets_s[k] += step(offsets_[k].at);
    }
    for (std::size_t s = 0; s < velocities_.size(); ++s) {
      if (!velocities_[s]) continue;
      state.velocities[s] = stepped(state.velocities[s], step.segment<6>(velocities_[s].at));
    }
  }

  /// Whether a pass has converged: the step hardly changes poses and clock offsets, and its change
  /// of the velocities hardly moves the points of a scan, compared with the distance of the pass.
  bool is_small(const Eigen::VectorXd& step, double max_distance_m) const {
    constexpr double kScan_s = 0.1;
    // In the pass of 0.3 m: 1 mm, 0.006 degrees, 30 microseconds.
    const double translation_m = max_distance_m / 300.0;
    const double rotation_rad = max_distance_m / 3000.0;
    const double offset_s = max_distance_m / 1e4;
    const auto is_still = [&](const Block& block, double scale) {
      return !block || (step.segment<3>(block.at).norm() * scale <= rotation_rad &&
                        step.segment<3>(block.at + 3).norm() * scale <= translation_m);
    };
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (!is_still(poses_[k], 1.0)) return false;
      if (offsets_[k] && std::abs(step(offsets_[k].at)) > offset_s) return false;
    }
    return std::all_of(velocities_.begin(), velocities_.end(),
                       [&](const Block& velocity) { return is_still(velocity, kScan_s); });
  }

  /// Whether the last few steps lead back to where they began: the correspondences alternate, and
  /// no further iteration changes that.
  bool lead_back(const std::vector<Eigen::VectorXd>& steps, double max_distance_m) const {
    constexpr std::size_t kMaxPeriod = 6;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns_);
    for (std::size_t n = 0; n < std::min(steps.size(), kMaxPeriod); ++n) {
      sum += steps[steps.size() - 1 - n];
      if (n > 0 && is_small(sum, max_distance_m)) return true;
    }
    return false;
  }

  const std::vector<JointScene>& scenes_;
  const JointOptions& options_;
  Eigen::Index unknowns_ = 0;
  std::vector<Block> poses_, offsets_;  ///< By sensor; the offsets are those of the clocks.
  std::vector<Block> velocities_;       ///< By scene.
};

}  // namespace

const params::Table<JointOptions>& joint_table() {
  static const params::Table<JointOptions> table = [] {
    params::Table<JointOptions> rows = {
        params::numbers("max_distances_m", &JointOptions::max_distances_m, {1e-6, 1e6},
                        "Maximum distances between corresponding points; one pass for each."),
        params::numbers(
            "velocity_std", &JointOptions::velocity_std, {1e-9, 1e6},
            "Prior standard deviations of a velocity about zero: the first in m/s, along each "
            "axis; the second in rad/s, about each axis."),
        params::number("clock_offset_std_s", &JointOptions::clock_offset_std_s, {0.0, 1e6},
                       "Prior standard deviation of the offset of a sensor's clock from the "
                       "target's; at 0 the clocks agree."),
        params::integer("max_iterations", &JointOptions::max_iterations, {1, 10000},
                        "Maximum number of iterations of each pass."),
        params::numbers("step_tolerance", &JointOptions::step_tolerance, {0.0, 1e3},
                        "A pass ends when its step is shorter than this, in standard deviations "
                        "of the unknowns if the residuals were independent: the first in passes "
                        "before the last, the second in the last."),
        params::integer("points", &JointOptions::points, {30, 100000000},
                        "Number of points of each scan that are used, evenly spaced; four times as "
                        "many to compare speeds."),
        params::integer("normal_neighbours", &JointOptions::normal_neighbours, {3, 1000},
                        "Number of neighbours from which a normal is computed."),
        params::number("max_normal_angle_deg", &JointOptions::max_normal_angle_deg, {0.0, 180.0},
                       "Maximum angle between the normals of corresponding points."),
        params::number("patch_m", &JointOptions::patch_m, {1e-3, 1e6},
                       "Edge of the cubes that divide surfaces of about the same direction into "
                       "patches."),
        params::number("patch_balance", &JointOptions::patch_balance, {0.0, 1.0},
                       "Each of the n points of a patch is weighted by n^-k, k being this: at 1 "
                       "every patch has the same weight, at 0 every point. It keeps one large "
                       "moving object from outvoting many small static ones."),
        params::number(
            "patch_kernel_m", &JointOptions::patch_kernel_m, {0.0, 1e6},
            "A patch with a larger mean residual loses weight as a whole, because it moves "
            "independently. At least a tenth of a pass's distance; at 0 no patch loses weight."),
        params::number("vehicle_weight", &JointOptions::vehicle_weight, {0.0, 1.0},
                       "Weight of a point of the reference that belongs to a vehicle-sized object, "
                       "which may be moving; other points have the weight 1."),
        params::number(
            "kernel_width_m", &JointOptions::kernel_width_m, {1e-6, 1e6},
            "Larger residuals lose weight. At least a quarter of a pass's distance, e.g. 0.075 m "
            "in a pass of 0.3 m; priors, and the agreement of points with other speeds, use "
            "exactly this value."),
    };
    rows.require([](const JointOptions& o) { return !o.max_distances_m.empty(); },
                 "max_distances_m must have a number");
    rows.require([](const JointOptions& o) { return o.velocity_std.size() == 2; },
                 "velocity_std must have two numbers, m/s and rad/s");
    rows.require([](const JointOptions& o) { return o.step_tolerance.size() == 2; },
                 "step_tolerance must have two numbers");
    rows.require([](const JointOptions& o) { return is_clock_std(o.clock_offset_std_s); },
                 kClockStdIs);
    return rows;
  }();
  return table;
}

JointRegistration register_jointly(const std::vector<JointScene>& scenes, JointState start,
                                   const JointOptions& options) {
  JointRegistration outcome;
  const std::size_t sensors = start.T_target_sensor.size();
  outcome.state = std::move(start);
  const JointProblem problem(scenes, options, sensors);
  std::vector<DeskewedTarget> targets = problem.targets_at(outcome.state);
  for (const double distance : options.max_distances_m) problem.run(outcome, targets, distance);
  return outcome;
}

}  // namespace croon
