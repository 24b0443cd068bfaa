#include "framework/registration/bundle_adjustment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "framework/registration/bundle_system.hpp"
#include "framework/registration/bundle_uncertainty.hpp"

namespace croon {
namespace {

bool is_step_small(const Eigen::VectorXd& step) {
  constexpr double kRotation_rad = 1e-8, kTranslation_m = 1e-7;
  for (Eigen::Index at = 0; at < step.size(); at += 6) {
    if (step.segment<3>(at).norm() > kRotation_rad ||
        step.segment<3>(at + 3).norm() > kTranslation_m) {
      return false;
    }
  }
  return true;
}

bool are_same(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
  constexpr double kRotation_rad = 2e-6, kTranslation_m = 2e-5;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const PoseError moved = pose_error(a[k], b[k]);
    if (moved.rotation_rad > kRotation_rad || moved.translation_m > kTranslation_m) return false;
  }
  return true;
}

bool is_unmoved(const BundleState& state, const BundleState& before) {
  for (std::size_t k = 0; k < state.poses.size(); ++k) {
    if (state.poses[k].rotation != before.poses[k].rotation ||
        state.poses[k].translation != before.poses[k].translation) {
      return false;
    }
  }
  return true;
}

/// The damping of Levenberg and Marquardt: the diagonal grows by this share of itself.
BundleCost damped(BundleCost cost, double damping) {
  cost.hessian.diagonal() += damping * cost.hessian.diagonal().cwiseAbs();
  return cost;
}

/// The state after Newton's step with this damping; none if the Hessian is not positive, and the
/// state itself if the step is small.
std::optional<BundleState> newton_step(const BundleSystem& system,
                                       const std::vector<BundleCost>& scenes,
                                       const BundleCost& start, double damping) {
  BundleState state = system.state();
  BundleCost poses = damped(start, damping);
  std::vector<ReducedCost> costs;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    costs.push_back(reduced(damped(scenes[s], damping), state.velocities[s].has_value()));
    poses.gradient += costs.back().gradient;
    poses.hessian += costs.back().hessian;
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(poses.hessian);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd step = -factors.solve(poses.gradient);
  if (is_step_small(step)) return state;
  const std::vector<std::size_t>& sensors = system.free_sensors();
  for (std::size_t a = 0; a < sensors.size(); ++a) {
    RigidTransform& T = state.poses[sensors[a]];
    T = stepped(T, step.segment<6>(static_cast<Eigen::Index>(6 * a)));
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    std::optional<Twist>& velocity = state.velocities[s];
    if (velocity) velocity = stepped(*velocity, costs[s].rest + costs[s].by_pose * step);
  }
  return state;
}

/// One step that lowers the cost. Whether it moved a sensor.
bool improve(BundleSystem& system, double& damping) {
  constexpr double kLargestDamping = 1e6;
  const BundleCost start = system.start_cost();
  std::vector<BundleCost> scenes;
  for (std::size_t s = 0; s < system.planes().size(); ++s) {
    scenes.push_back(system.scene_cost(s, system.planes()[s], true));
  }
  const double present = system.value_in(system.state());
  for (; damping <= kLargestDamping; damping *= 10.0) {
    std::optional<BundleState> next = newton_step(system, scenes, start, damping);
    if (!next) continue;
    if (is_unmoved(*next, system.state())) return false;
    if (!(system.value_in(*next) < present)) continue;
    system.set_state(std::move(*next));
    damping = std::max(0.1 * damping, 1e-9);
    return true;
  }
  return false;
}

/// Looks for planes and moves the sensors until they stay. Whether they stayed at once.
bool pass(BundleSystem& system, int stride, const BundleOptions& options, Bundle& bundle) {
  system.find_planes(stride);
  const std::vector<RigidTransform> before = system.state().poses;
  ++bundle.passes;
  if (system.free_sensors().empty()) return true;
  double damping = 1e-6;
  for (int i = 0; i < options.max_iterations; ++i) {
    ++bundle.iterations;
    if (!improve(system, damping)) break;
  }
  return are_same(before, system.state().poses);
}

}  // namespace

const params::Table<BundleOptions>& bundle_table() {
  using O = BundleOptions;
  static const params::Table<O> table = [] {
    params::Table<O> rows = {
        params::numbers("voxels_m", &O::voxels_m, {1e-3, 1e6},
                        "The edges of the largest and of the smallest voxels; a voxel that holds "
                        "no plane is cut into eight."),
        params::number("max_thickness_ratio", &O::max_thickness_ratio, {0.0, 1.0},
                       "Points are on a plane if their variance across it is at most this share of "
                       "the middle one."),
        params::integer("min_points", &O::min_points, {4, 1000000},
                        "A plane has at least so many points, of all sensors together."),
        params::integer("min_sensor_points", &O::min_sensor_points, {1, 1000000},
                        "A sensor that has fewer points on a plane does not see it."),
        params::number("surface_error_m", &O::surface_error_m, {0.0, 1e3},
                       "What a surface is off a plane: however many points a sensor has on it, "
                       "they do not know the plane better."),
        params::number("kernel_width", &O::kernel_width, {1e-3, 1e9},
                       "Planes that fit worse than so many standard deviations lose weight."),
        params::numbers("start_std", &O::start_std, {1e-9, 1e9},
                        "How far a start is expected to be off, degrees and metres: standard "
                        "deviations about each axis and along it. It keeps sensors from moving "
                        "where no plane holds them."),
        params::number(
            "start_weight", &O::start_weight, {0.0, 1.0},
            "The weight of what steps before know of poses and velocities, by covariances: "
            "the inverse of how many times larger that is taken to be, because both saw "
            "the same points. 0 takes the start as a start alone."),
        params::integer("coarse_stride", &O::coarse_stride, {1, 1000000},
                        "Coarse passes take one of so many points."),
        params::integer("coarse_passes", &O::coarse_passes, {0, 1000},
                        "The number of coarse passes."),
        params::integer("max_passes", &O::max_passes, {1, 1000},
                        "The most passes over all points; they end when no sensor moves."),
        params::integer("max_iterations", &O::max_iterations, {1, 10000},
                        "The most iterations of each pass."),
        params::integer(
            "min_planes", &O::min_planes, {1, 1000000},
            "A sensor that shares fewer planes with others is not adjusted: it keeps its start "
            "if a step before has given it a covariance, and fails if not."),
        params::number("covariance_scale", &O::covariance_scale, {0.0, 1e6},
                       "Multiplies the standard deviations; found on scenes with truth."),
    };
    rows.require([](const O& o) { return o.voxels_m.size() == 2; },
                 "voxels_m must have two numbers");
    rows.require([](const O& o) { return o.start_std.size() == 2; },
                 "start_std must have two numbers");
    return rows;
  }();
  return table;
}

Bundle adjust_bundle(const std::vector<BundleScene>& scenes, const std::vector<BundleStart>& start,
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
  bundle.covariances = bundle_covariances(system, options);
  const double planes = static_cast<double>(std::max<std::size_t>(system.number_of_planes(), 1));
  bundle.cost_per_plane = system.value_in(system.state()) / planes;
  return bundle;
}

}  // namespace croon
