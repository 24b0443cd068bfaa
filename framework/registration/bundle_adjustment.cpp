#include "framework/registration/bundle_adjustment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "framework/registration/bundle_system.hpp"
#include "framework/registration/bundle_uncertainty.hpp"
#include "framework/registration/clock_offset.hpp"

namespace croon {
namespace {

/// Whether a step is small. It contains the changes of the poses of `sensors` sensors, optionally
/// followed by those of their clock offsets.
bool is_step_small(const Eigen::VectorXd& step, std::size_t sensors) {
  constexpr double kRotation_rad = 1e-8, kTranslation_m = 1e-7, kOffset_s = 1e-9;
  const auto offsets_at = static_cast<Eigen::Index>(6 * sensors);
  for (Eigen::Index at = 0; at < offsets_at; at += 6) {
    if (step.segment<3>(at).norm() > kRotation_rad ||
        step.segment<3>(at + 3).norm() > kTranslation_m) {
      return false;
    }
  }
  return (step.tail(step.size() - offsets_at).array().abs() <= kOffset_s).all();
}

/// Whether the poses differ by much less than the standard deviations of real sensors' poses.
bool are_same(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
  constexpr double kRotation_rad = 1e-5, kTranslation_m = 1e-4;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const PoseError moved = pose_error(a[k], b[k]);
    if (moved.rotation_rad > kRotation_rad || moved.translation_m > kTranslation_m) return false;
  }
  return true;
}

/// Levenberg-Marquardt damping: increases the diagonal by this fraction.
BlockSystem damped(BlockSystem cost, double damping) {
  cost.hessian.diagonal() += damping * cost.hessian.diagonal().cwiseAbs();
  return cost;
}

/// A Newton step: the resulting state, and whether the step is too small to be made.
struct NewtonStep {
  BundleState state;
  bool is_small = false;
};

/// The step with this damping; std::nullopt if the Hessian is not positive definite.
std::optional<NewtonStep> newton_step(const BundleSystem& system,
                                      const std::vector<BlockSystem>& scenes,
                                      const BlockSystem& start, double damping) {
  NewtonStep result = {system.state()};
  BlockSystem poses = damped(start, damping);
  std::vector<ReducedCost> costs;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    costs.push_back(reduced(damped(scenes[s], damping), result.state.velocities[s].has_value()));
    poses.gradient += costs.back().gradient;
    poses.hessian += costs.back().hessian;
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(poses.hessian);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd step = -factors.solve(poses.gradient);
  result.is_small = is_step_small(step, system.free_sensors().size());
  for (const std::size_t k : system.free_sensors()) {
    RigidTransform& T = result.state.poses[k];
    T = stepped(T, step.segment<6>(system.pose_block(k).at));
    const Block& clock = system.clock_block(k);
    if (clock) result.state.clock_offsets_s[k] += step(clock.at);
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    std::optional<Twist>& velocity = result.state.velocities[s];
    if (velocity) velocity = stepped(*velocity, costs[s].rest + costs[s].by_pose * step);
  }
  return result;
}

/// Makes one step that lowers the cost `value`. Returns whether it moved a sensor.
bool improve(BundleSystem& system, double& value, double& damping) {
  constexpr double kMaxDamping = 1e6;
  const BlockSystem start = system.start_cost();
  std::vector<BlockSystem> scenes;
  for (std::size_t s = 0; s < system.planes().size(); ++s) {
    scenes.push_back(system.scene_cost(s, system.planes()[s], true));
  }
  for (; damping <= kMaxDamping; damping *= 10.0) {
    std::optional<NewtonStep> next = newton_step(system, scenes, start, damping);
    if (!next) continue;
    if (next->is_small) return false;
    const double next_value = system.value_in(next->state);
    if (!(next_value < value)) continue;
    value = next_value;
    system.set_state(std::move(next->state));
    damping = std::max(0.1 * damping, 1e-9);
    return true;
  }
  return false;
}

/// Finds planes and moves the sensors until convergence. Returns whether no sensor moved.
bool pass(BundleSystem& system, int stride, const BundleOptions& options, Bundle& bundle) {
  system.find_planes(stride);
  const std::vector<RigidTransform> before = system.state().poses;
  ++bundle.passes;
  if (system.free_sensors().empty()) return true;
  double value = system.value_in(system.state()), damping = 1e-6;
  for (int i = 0; i < options.max_iterations; ++i) {
    ++bundle.iterations;
    if (!improve(system, value, damping)) break;
  }
  return are_same(before, system.state().poses);
}

}  // namespace

// Not in the header: GCC 12 reports uninitialised vectors in aggregates with such a base.
BundleOptions::BundleOptions() = default;

const params::Table<BundleOptions>& bundle_table() {
  using O = BundleOptions;
  static const params::Table<O> table = [] {
    params::Table<O> rows = {
        params::number("kernel_width", &O::kernel_width, {1e-3, 1e9},
                       "Kernel width in standard deviations: planes that fit worse lose weight."),
        params::numbers(
            "prior_std", &O::prior_std, {1e-9, 1e9},
            "Prior standard deviations of the error of an initial pose: the first in degrees, "
            "about each axis; the second in metres, along each axis. They keep sensors from moving "
            "in directions that no plane constrains.")
            .formerly("start_std"),
        params::number(
            "prior_weight", &O::prior_weight, {0.0, 1.0},
            "Factor on the inverse covariances of poses and velocities from earlier steps, at most "
            "1 because the bundle adjustment uses the same points again. At 0 they are only "
            "initial values.")
            .formerly("start_weight"),
        params::integer("coarse_stride", &O::coarse_stride, {1, 1000000},
                        "Coarse passes use every n-th point."),
        params::integer("coarse_passes", &O::coarse_passes, {0, 1000}, "Number of coarse passes."),
        params::integer("max_passes", &O::max_passes, {1, 1000},
                        "Maximum number of passes over all points; they end when no sensor moves."),
        params::integer("max_iterations", &O::max_iterations, {1, 10000},
                        "Maximum number of iterations of each pass."),
        params::integer(
            "min_planes", &O::min_planes, {1, 1000000},
            "Minimum number of planes (counted in each of the two grids) that a sensor must share "
            "with others to be adjusted. Otherwise it keeps its initial pose if an earlier step "
            "computed a covariance, and fails if not."),
        params::number("std_scale", &O::std_scale, {0.0, 1e6},
                       "Factor on the standard deviations; tuned on scenes with ground truth.")
            .formerly("covariance_scale"),
        params::number("velocity_error_std_mps", &O::velocity_error_std_mps, {0.0, 1e6},
                       "Standard deviation of a speed error that is added to the uncertainty of "
                       "the poses in a scene with an uncertain velocity; tuned on scenes with "
                       "ground truth.")
            .formerly("velocity_error_mps"),
        params::number("clock_offset_std_s", &O::clock_offset_std_s, {0.0, 1e6},
                       "Prior standard deviation of the offset of a sensor's clock from the "
                       "target's, beyond what an earlier step has corrected. At 0 the clocks "
                       "agree; otherwise the offset is estimated from scenes with different "
                       "velocities."),
    };
    rows.inherit(voxel_table());
    rows.require([](const O& o) { return o.prior_std.size() == 2; },
                 "prior_std must have two numbers, degrees and metres");
    rows.require([](const O& o) { return is_clock_std(o.clock_offset_std_s); }, kClockStdIs);
    return rows;
  }();
  return table;
}

Bundle adjust_bundle(const std::vector<BundleScene>& scenes, const std::vector<InformedPose>& start,
                     const BundleOptions& options) {
  Bundle bundle;
  BundleSystem system(scenes, start, options);
  for (int i = 0; i < options.coarse_passes; ++i) {
    if (pass(system, options.coarse_stride, options, bundle)) break;
  }
  for (int i = 0; i < options.max_passes && !bundle.converged; ++i) {
    bundle.converged = pass(system, 1, options, bundle);
  }
  bundle.poses = system.state().poses;
  bundle.velocities = system.state().velocities;
  bundle.planes = system.planes_of_sensors();
  bundle.clock_offsets_s = system.state().clock_offsets_s;
  BundleUncertainty uncertainty = bundle_uncertainty(system, options);
  bundle.covariances = std::move(uncertainty.covariances);
  bundle.plane_observability = plane_observability(system);
  bundle.clock_offset_stds_s = std::move(uncertainty.clock_offset_stds_s);
  const double planes = static_cast<double>(std::max<std::size_t>(system.number_of_planes(), 1));
  bundle.cost_per_plane = system.value_in(system.state()) / planes;
  return bundle;
}

}  // namespace croon
