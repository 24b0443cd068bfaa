#include "framework/registration/bundle_adjustment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "framework/base/angles.hpp"
#include "framework/base/threads.hpp"
#include "framework/registration/bundle_cost.hpp"
#include "framework/registration/direction_balance.hpp"

namespace croon {
namespace {

/// The pose after a step of six, in the order of Dof.
RigidTransform stepped(const RigidTransform& T, const Vector6d& step) {
  return {nearest_rotation(rotation_exp(step.head<3>()) * T.rotation),
          T.translation + step.tail<3>()};
}

bool is_step_small(const Eigen::VectorXd& step, double rotation_rad, double translation_m) {
  for (Eigen::Index at = 0; at < step.size(); at += 6) {
    if (step.segment<3>(at).norm() > rotation_rad ||
        step.segment<3>(at + 3).norm() > translation_m) {
      return false;
    }
  }
  return true;
}

/// How far `T` is from `start`, in the order of Dof, in units of `start_std`.
Vector6d moved_by(const RigidTransform& T, const RigidTransform& start, const Vector6d& std) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(T.rotation * start.rotation.transpose()));
  Vector6d offset;
  offset << turn.angle() * turn.axis(), T.translation - start.translation;
  return offset.cwiseQuotient(std);
}

class Adjustment {
 public:
  Adjustment(const std::vector<BundleScene>& scenes, const BundleOptions& options, Bundle& bundle)
      : scenes_(scenes), options_(options), bundle_(bundle), start_(bundle.poses) {
    start_std_ << Eigen::Vector3d::Constant(rad_from_deg(options.start_std[0])),
        Eigen::Vector3d::Constant(options.start_std[1]);
  }

  /// The covariances at the present poses, by the planes of the last pass.
  void find_covariances() {
    bundle_.covariances.assign(bundle_.poses.size(), {});
    const std::vector<std::size_t> sensors = free_sensors();
    if (sensors.empty()) return;
    const BundleCost cost = bundle_cost(patches_, bundle_.poses, options_.kernel_width);
    Eigen::MatrixXd hessian = part_of(cost.hessian, sensors);
    for (std::size_t a = 0; a < sensors.size(); ++a) add_start_information(hessian, a);
    const Eigen::MatrixXd inverse =
        hessian.ldlt().solve(Eigen::MatrixXd::Identity(hessian.rows(), hessian.cols()));
    const Eigen::MatrixXd covariance = inverse * part_of(scatter_of_gradients(), sensors) * inverse;
    const double scale = options_.covariance_scale * options_.covariance_scale;
    for (std::size_t a = 0; a < sensors.size(); ++a) {
      const auto at = static_cast<Eigen::Index>(6 * a);
      const Matrix6d own = scale * covariance.block<6, 6>(at, at);
      PoseCovariance& result = bundle_.covariances[sensors[a]];
      result.matrix = 0.5 * (own + own.transpose());
      for (std::size_t dof = 0; dof < result.dofs.size(); ++dof) {
        const auto i = static_cast<Eigen::Index>(dof);
        result.dofs[dof] = word_of(std::sqrt(result.matrix(i, i)) / start_std_(i));
      }
    }
  }

  /// Looks for planes and moves the sensors until they stay. Whether they stayed at once.
  bool pass(bool is_coarse) {
    patches_ = patches_at(is_coarse);
    const std::vector<RigidTransform> before = bundle_.poses;
    minimise(patches_);
    ++bundle_.passes;
    return are_same(before, bundle_.poses);
  }

 private:
  std::vector<PlanePatch> patches_at(bool is_coarse) {
    VoxelOptions voxels;
    voxels.voxel_m = options_.voxels_m.front();
    voxels.least_voxel_m = options_.voxels_m.back();
    voxels.max_thickness_ratio = options_.max_thickness_ratio;
    voxels.min_points = options_.min_points;
    voxels.min_sensor_points = options_.min_sensor_points;
    voxels.surface_error_m = options_.surface_error_m;
    const int stride = is_coarse ? options_.coarse_stride : 1;
    std::vector<std::vector<PlanePatch>> parts(scenes_.size());
    for_each_in_parallel(scenes_.size(), [&](std::size_t s) {
      parts[s] = plane_patches(scenes_[s], bundle_.poses, stride, voxels);
    });
    std::vector<PlanePatch> patches;
    scene_ends_.clear();
    for (std::vector<PlanePatch>& part : parts) {
      std::move(part.begin(), part.end(), std::back_inserter(patches));
      scene_ends_.push_back(patches.size());
    }
    count_planes(patches);
    return patches;
  }

  void count_planes(const std::vector<PlanePatch>& patches) {
    bundle_.planes.assign(bundle_.poses.size(), 0);
    for (const PlanePatch& patch : patches) {
      for (const PlanePatch::View& view : patch.views) ++bundle_.planes[view.sensor];
    }
  }

  /// The rows and columns of the unknown poses.
  static Eigen::MatrixXd part_of(const Eigen::MatrixXd& matrix,
                                 const std::vector<std::size_t>& sensors) {
    const auto size = static_cast<Eigen::Index>(6 * sensors.size());
    Eigen::MatrixXd part(size, size);
    for (std::size_t a = 0; a < sensors.size(); ++a) {
      for (std::size_t b = 0; b < sensors.size(); ++b) {
        part.block<6, 6>(static_cast<Eigen::Index>(6 * a), static_cast<Eigen::Index>(6 * b)) =
            matrix.block<6, 6>(static_cast<Eigen::Index>(6 * sensors[a]),
                               static_cast<Eigen::Index>(6 * sensors[b]));
      }
    }
    return part;
  }

  /// Adds what is known of a start to the Hessian of the unknown pose number `a`.
  void add_start_information(Eigen::MatrixXd& hessian, std::size_t a) const {
    const auto at = static_cast<Eigen::Index>(6 * a);
    hessian.block<6, 6>(at, at).diagonal() += 2.0 * start_std_.cwiseAbs2().cwiseInverse();
  }

  static Observability word_of(double std_ratio) {
    constexpr double kWeak = 0.1, kUnobservable = 0.5;
    if (std_ratio > kUnobservable) return Observability::unobservable;
    return std_ratio > kWeak ? Observability::weak : Observability::determined;
  }

  /// The sum of g g^T over the gradients g of clusters of planes, and what is known of the starts.
  Eigen::MatrixXd scatter_of_gradients() const {
    constexpr double kCell_m = 8.0;
    const double bound = options_.kernel_width * options_.kernel_width;
    const auto size = static_cast<Eigen::Index>(6 * bundle_.poses.size());
    std::map<std::array<int, 5>, Eigen::VectorXd> gradients;
    PlaneCost cost;
    int scene = 0;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      while (i >= scene_ends_[static_cast<std::size_t>(scene)]) ++scene;
      plane_cost(patches_[i], bundle_.poses, cost);
      const Eigen::Vector3d cell = cost.centre / kCell_m;
      const std::array<int, 5> cluster = {
          scene, direction_bin(cost.normal), static_cast<int>(std::floor(cell.x())),
          static_cast<int>(std::floor(cell.y())), static_cast<int>(std::floor(cell.z()))};
      Eigen::VectorXd& gradient =
          gradients.emplace(cluster, Eigen::VectorXd::Zero(size)).first->second;
      const double share = bound / (bound + cost.value);
      for (std::size_t k = 0; k < cost.views.size(); ++k) {
        gradient.segment<6>(static_cast<Eigen::Index>(6 * patches_[i].views[k].sensor)) +=
            share * share * cost.views[k].gradient;
      }
    }
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
    for (const auto& [cluster, gradient] : gradients) sum += gradient * gradient.transpose();
    for (Eigen::Index at = 0; at < size; at += 6) {
      sum.block<6, 6>(at, at).diagonal() += 4.0 * start_std_.cwiseAbs2().cwiseInverse();
    }
    return sum;
  }

  /// The sensors whose poses are unknown.
  std::vector<std::size_t> free_sensors() const {
    std::vector<std::size_t> sensors;
    for (std::size_t k = 1; k < bundle_.poses.size(); ++k) {
      if (bundle_.planes[k] >= options_.min_planes) sensors.push_back(k);
    }
    return sensors;
  }

  void minimise(const std::vector<PlanePatch>& patches) {
    const std::vector<std::size_t> sensors = free_sensors();
    bundle_.converged = sensors.empty();
    double damping = 1e-6;
    for (int i = 0; i < options_.max_iterations && !bundle_.converged; ++i) {
      const BundleCost cost = bundle_cost(patches, bundle_.poses, options_.kernel_width);
      bundle_.cost_per_plane =
          cost.value / static_cast<double>(std::max<std::size_t>(patches.size(), 1));
      bundle_.converged = !improve(patches, sensors, cost, damping);
      ++bundle_.iterations;
    }
  }

  /// What moving the sensors from their start costs.
  double start_cost(const std::vector<RigidTransform>& poses) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < poses.size(); ++k) {
      sum += moved_by(poses[k], start_[k], start_std_).squaredNorm();
    }
    return sum;
  }

  /// One step that lowers the cost. Whether it moved anything.
  bool improve(const std::vector<PlanePatch>& patches, const std::vector<std::size_t>& sensors,
               const BundleCost& cost, double& damping) {
    constexpr double kLargestDamping = 1e6;
    const auto size = static_cast<Eigen::Index>(6 * sensors.size());
    Eigen::MatrixXd hessian = part_of(cost.hessian, sensors);
    Eigen::VectorXd gradient(size);
    for (std::size_t a = 0; a < sensors.size(); ++a) {
      const std::size_t sensor = sensors[a];
      const Vector6d offset = moved_by(bundle_.poses[sensor], start_[sensor], start_std_);
      gradient.segment<6>(static_cast<Eigen::Index>(6 * a)) =
          cost.gradient.segment<6>(static_cast<Eigen::Index>(6 * sensor)) +
          2.0 * offset.cwiseQuotient(start_std_);
      add_start_information(hessian, a);
    }
    const double present = cost.value + start_cost(bundle_.poses);
    for (; damping <= kLargestDamping; damping *= 10.0) {
      Eigen::MatrixXd damped = hessian;
      damped.diagonal() += damping * hessian.diagonal().cwiseAbs();
      const Eigen::LLT<Eigen::MatrixXd> factors(damped);
      if (factors.info() != Eigen::Success) continue;
      const Eigen::VectorXd step = -factors.solve(gradient);
      if (is_step_small(step, 1e-8, 1e-7)) return false;
      std::vector<RigidTransform> poses = bundle_.poses;
      for (std::size_t a = 0; a < sensors.size(); ++a) {
        RigidTransform& T = poses[sensors[a]];
        T = stepped(T, step.segment<6>(static_cast<Eigen::Index>(6 * a)));
      }
      const double value = bundle_value(patches, poses, options_.kernel_width) + start_cost(poses);
      if (!(value < present)) continue;
      bundle_.poses = std::move(poses);
      damping = std::max(0.1 * damping, 1e-9);
      return true;
    }
    return false;
  }

  static bool are_same(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
    constexpr double kRotation_rad = 2e-6, kTranslation_m = 2e-5;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const PoseError moved = pose_error(a[k], b[k]);
      if (moved.rotation_rad > kRotation_rad || moved.translation_m > kTranslation_m) return false;
    }
    return true;
  }

  const std::vector<BundleScene>& scenes_;
  const BundleOptions& options_;
  Bundle& bundle_;
  std::vector<RigidTransform> start_;
  Vector6d start_std_;
  std::vector<PlanePatch> patches_;      ///< Of the last pass, by scene.
  std::vector<std::size_t> scene_ends_;  ///< By scene: the number of patches up to its last.
};

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
        params::integer("coarse_stride", &O::coarse_stride, {1, 1000000},
                        "Coarse passes take one of so many points."),
        params::integer("coarse_passes", &O::coarse_passes, {0, 1000},
                        "The number of coarse passes."),
        params::integer("max_passes", &O::max_passes, {1, 1000},
                        "The most passes over all points; they end when no sensor moves."),
        params::integer("max_iterations", &O::max_iterations, {1, 10000},
                        "The most iterations of each pass."),
        params::integer("min_planes", &O::min_planes, {1, 1000000},
                        "A sensor that shares fewer planes with others fails."),
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

Bundle adjust_bundle(const std::vector<BundleScene>& scenes,
                     const std::vector<RigidTransform>& start, const BundleOptions& options) {
  Bundle bundle;
  bundle.poses = start;
  Adjustment adjustment(scenes, options, bundle);
  for (int i = 0; i < options.coarse_passes; ++i) {
    if (adjustment.pass(true)) break;
  }
  bool stays = false;
  for (int i = 0; i < options.max_passes && !stays; ++i) stays = adjustment.pass(false);
  bundle.converged = stays;
  adjustment.find_covariances();
  return bundle;
}

}  // namespace croon
