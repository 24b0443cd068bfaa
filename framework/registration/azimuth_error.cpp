#include "framework/registration/azimuth_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/registration/surface_key.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

/// The factors of sine, cosine and slope at a point: sin a, cos a and e.
Eigen::Vector3d terms_at(const Eigen::Vector3d& point) {
  const double across = std::hypot(point.x(), point.y());
  if (!(across > 0.0)) return Eigen::Vector3d::Zero();
  return {point.y() / across, point.x() / across, std::atan2(point.z(), across)};
}

/// The error whose mean is zero over points with the mean terms `mean`.
AzimuthError error_of(const Eigen::Vector3d& sizes, const Eigen::Vector3d& mean) {
  return {-sizes.dot(mean), sizes.x(), sizes.y(), sizes.z()};
}

/// A point on a surface of the target, linearised.
struct Contact {
  Vector6d by_pose;         ///< The Jacobian of its distance with respect to `moved`,
  Eigen::Vector3d by_size;  ///< and to sine, cosine and slope.
  double distance_m = 0.0;
  SurfaceKey surface;
};

/// A view and the points of it that are used.
class ViewProblem {
 public:
  /// Uses at most `max_points` points of the source, evenly spaced.
  ViewProblem(const AzimuthView& view, const AzimuthOptions& options, std::size_t max_points)
      : view_(view),
        options_(options),
        min_cosine_(std::max(std::cos(rad_from_deg(options.max_normal_angle_deg)), 1e-9)),
        target_tree_(view.target->kd_tree()),
        target_normals_(view.target->normals(options.normal_neighbours)),
        source_normals_(view.source->normals(options.normal_neighbours)) {
    const std::size_t size = view.source->points().size();
    const std::size_t count = std::min(size, max_points);
    for (std::size_t i = 0; i < count; ++i) {
      indices_.push_back(static_cast<int>(evenly_spaced_index(i, size, count)));
    }
  }

  std::size_t points() const { return indices_.size(); }

  Eigen::Vector3d sum_of_terms() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int index : indices_) sum += terms_at(point_at(index));
    return sum;
  }

  std::vector<Contact> contacts(const RigidTransform& T, const AzimuthError& error,
                                const Eigen::Vector3d& mean_terms) const {
    std::vector<Contact> found;
    Contact contact;
    for (const int index : indices_) {
      if (touches(index, T, error, mean_terms, contact)) found.push_back(contact);
    }
    return found;
  }

 private:
  Eigen::Vector3d point_at(int index) const { return view_.source->points()[index].cast<double>(); }

  bool touches(int index, const RigidTransform& T, const AzimuthError& error,
               const Eigen::Vector3d& mean_terms, Contact& contact) const {
    const Eigen::Vector3d reported = point_at(index);
    const Eigen::Vector3d point = without_error(reported, error);
    const Eigen::Vector3d arm = T.rotation * point;
    const Eigen::Vector3d in_target = arm + T.translation;
    const Neighbour nearest =
        target_tree_.nearest(in_target.cast<float>(), static_cast<float>(options_.max_distance_m));
    if (!nearest) return false;
    const Eigen::Vector3d normal = target_normals_.at(nearest.index).normal.cast<double>();
    const Eigen::Vector3d own = T.rotation * source_normals_.at(index).normal.cast<double>();
    if (!(std::abs(normal.dot(own)) > min_cosine_)) return false;
    contact.by_pose = plane_jacobian(arm, normal);
    const Eigen::Vector3d turned = T.rotation * Eigen::Vector3d(point.y(), -point.x(), 0.0);
    contact.by_size = normal.dot(turned) * (terms_at(reported) - mean_terms);
    contact.distance_m =
        normal.dot(in_target - view_.target->points()[nearest.index].cast<double>());
    contact.surface = surface_key(in_target, normal, options_.surface_size_m);
    return true;
  }

  AzimuthView view_;
  const AzimuthOptions& options_;
  double min_cosine_;  ///< Positive, because the product with a missing normal is zero.
  const KdTree& target_tree_;
  const Normals& target_normals_;
  const Normals& source_normals_;
  std::vector<int> indices_;
};

/// The weights of contacts: n^-`direction_balance` for n contacts of about the same direction,
/// times the weight of the robust kernel.
std::vector<double> weights_of(const std::vector<Contact>& contacts,
                               const AzimuthOptions& options) {
  DirectionCounts counts{};
  for (const Contact& contact : contacts) ++counts.at(contact.surface.second);
  const auto of_direction = direction_weights(counts, options.direction_balance);
  const RobustKernel kernel(Kernel::geman_mcclure, options.kernel_width_m);
  std::vector<double> weights;
  for (const Contact& contact : contacts) {
    weights.push_back(of_direction.at(contact.surface.second) *
                      kernel.weight(contact.distance_m * contact.distance_m));
  }
  return weights;
}

/// The normal equations of one view for sine, cosine and slope, with its pose eliminated.
struct ReducedView {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  ///< Of the gradients of surfaces.
  Vector6d pose_step = Vector6d::Zero();              ///< The step with constant sizes,
  Eigen::Matrix<double, 6, 3> pose_by_size =          ///< and per change of the sizes.
      Eigen::Matrix<double, 6, 3>::Zero();
  double square_sum = 0.0;
  double weight_sum = 0.0;
  double square_weight_sum = 0.0;  ///< Of the weights of surfaces.
  int correspondences = 0;
};

ReducedView reduced(const std::vector<Contact>& contacts, const AzimuthOptions& options) {
  using Vector9d = Eigen::Matrix<double, 9, 1>;
  const std::vector<double> weights = weights_of(contacts, options);
  Eigen::Matrix<double, 9, 9> information = Eigen::Matrix<double, 9, 9>::Zero();
  struct Surface {
    Vector9d gradient = Vector9d::Zero();
    double weight = 0.0;
  };
  std::map<SurfaceKey, Surface> surfaces;
  ReducedView view;
  view.correspondences = static_cast<int>(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    Vector9d J;
    J << contact.by_pose, contact.by_size;
    information.noalias() += weights[i] * (J * J.transpose());
    Surface& surface = surfaces[contact.surface];
    surface.gradient += weights[i] * contact.distance_m * J;
    surface.weight += weights[i];
    view.square_sum += weights[i] * contact.distance_m * contact.distance_m;
    view.weight_sum += weights[i];
  }
  const Matrix6d inverse = guarded_inverse<6>(information.topLeftCorner<6, 6>());
  const Eigen::Matrix<double, 6, 3> coupling = information.topRightCorner<6, 3>();
  view.pose_by_size = -inverse * coupling;
  view.information =
      information.bottomRightCorner<3, 3>() + coupling.transpose() * view.pose_by_size;
  Vector6d of_pose = Vector6d::Zero();
  for (const auto& [key, surface] : surfaces) {
    const Eigen::Vector3d own =
        surface.gradient.tail<3>() + view.pose_by_size.transpose() * surface.gradient.head<6>();
    view.square_weight_sum += surface.weight * surface.weight;
    of_pose += surface.gradient.head<6>();
    view.gradient += own;
    view.scatter += own * own.transpose();
  }
  view.pose_step = -inverse * of_pose;
  return view;
}

/// The state of an estimation and its next step.
class Problem {
 public:
  Problem(const std::vector<AzimuthView>& views, const AzimuthOptions& options)
      : options_(options) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t points = 0;
    const std::size_t max_points =
        static_cast<std::size_t>(options.points) / std::max<std::size_t>(views.size(), 1) + 1;
    for (const AzimuthView& view : views) {
      views_.emplace_back(view, options_, max_points);
      poses_.push_back(view.T_target_source);
      sum += views_.back().sum_of_terms();
      points += views_.back().points();
    }
    if (points > 0) mean_terms_ = sum / static_cast<double>(points);
  }

  /// Linearises all views at the current state. Throws StageError if each of them has too few
  /// correspondences.
  void linearise() {
    reduced_.clear();
    information_.setZero();
    gradient_.setZero();
    scatter_.setZero();
    int max_correspondences = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      reduced_.push_back(reduced_at(v, poses_[v], error()));
      const ReducedView& view = reduced_.back();
      information_ += view.information;
      gradient_ += view.gradient;
      scatter_ += view.scatter;
      max_correspondences = std::max(max_correspondences, view.correspondences);
    }
    if (max_correspondences < kMinAzimuthCorrespondences) {
      throw StageError("only " + std::to_string(max_correspondences) + " points correspond");
    }
  }

  /// Moves the state by a Gauss-Newton step. Returns whether the step was small.
  bool step() {
    const double expected_rad = rad_from_deg(options_.prior_std_deg);
    // Converts information to inverse variance, estimated from the scatter of the gradients.
    const double variance =
        std::max((guarded_inverse<3>(information_) * scatter_).trace() / 3.0, 1e-12);
    const double prior = variance / (expected_rad * expected_rad);
    information_.diagonal().array() += prior;
    const Eigen::Vector3d change = -guarded_inverse<3>(information_) * (gradient_ + prior * sizes_);
    sizes_ += change;
    double largest = change.cwiseAbs().maxCoeff();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Vector6d move = reduced_[v].pose_step + reduced_[v].pose_by_size * change;
      poses_[v] = stepped(poses_[v], move);
      largest = std::max(largest, move.cwiseAbs().maxCoeff());
    }
    constexpr double kSmall = 5e-6;  // Radians and metres.
    return largest < kSmall;
  }

  AzimuthError error() const { return error_of(sizes_, mean_terms_); }

  double rmse_m() const {
    double squares = 0.0, weights = 0.0;
    for (const ReducedView& view : reduced_) {
      squares += view.square_sum;
      weights += view.weight_sum;
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
  }

  /// Writes the solution, from the last linearisation, into `result`.
  void write_result(AzimuthCalibration& result) const {
    result.error = error();
    const Eigen::Matrix3d inverse = guarded_inverse<3>(measured_hessian());
    result.covariance = inverse * scatter_ * inverse;
    result.T_target_source = poses_;
    result.rmse_m = rmse_m();
    double weights = 0.0, squares = 0.0;
    for (const ReducedView& view : reduced_) {
      result.correspondences.push_back(view.correspondences);
      weights += view.weight_sum;
      squares += view.square_weight_sum;
    }
    result.surfaces = squares > 0.0 ? weights * weights / squares : 0.0;
  }

 private:
  /// A linearised view; zero, so that its pose stays, if it has too few correspondences.
  ReducedView reduced_at(std::size_t v, const RigidTransform& T, const AzimuthError& error) const {
    ReducedView view = reduced(views_[v].contacts(T, error, mean_terms_), options_);
    if (view.correspondences >= kMinAzimuthCorrespondences) return view;
    ReducedView nothing;
    nothing.correspondences = view.correspondences;
    return nothing;
  }

  /// The derivative of the gradient with respect to sine, cosine and slope, with the poses
  /// following, by finite differences. Correspondences change, so it is smaller than predicted from
  /// the current ones.
  Eigen::Matrix3d measured_hessian() const {
    constexpr double kOffset_rad = 2e-3;
    Eigen::Matrix3d hessian;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d offset = kOffset_rad * Eigen::Vector3d::Unit(k);
      hessian.col(k) = (gradient_at(offset) - gradient_at(-offset)) / (2.0 * kOffset_rad);
    }
    return symmetric<3>(hessian);
  }

  Eigen::Vector3d gradient_at(const Eigen::Vector3d& offset) const {
    const AzimuthError error = error_of(sizes_ + offset, mean_terms_);
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const RigidTransform T = stepped(poses_[v], reduced_[v].pose_by_size * offset);
      gradient += reduced_at(v, T, error).gradient;
    }
    return gradient;
  }

  AzimuthOptions options_;
  std::vector<ViewProblem> views_;
  std::vector<RigidTransform> poses_;
  Eigen::Vector3d sizes_ = Eigen::Vector3d::Zero();  ///< Sine, cosine, slope.
  Eigen::Vector3d mean_terms_ = Eigen::Vector3d::Zero();
  std::vector<ReducedView> reduced_;
  Eigen::Matrix3d information_, scatter_;
  Eigen::Vector3d gradient_;
};

}  // namespace

double AzimuthError::at(const Eigen::Vector3d& point) const {
  return offset_rad + terms_at(point).dot(Eigen::Vector3d(sine_rad, cosine_rad, slope));
}

Eigen::Vector3d without_error(const Eigen::Vector3d& point, const AzimuthError& error) {
  const double angle = error.at(point);
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * point.x() + s * point.y(), c * point.y() - s * point.x(), point.z()};
}

PointCloud without_error(PointCloud cloud, const AzimuthError& error) {
  for (Eigen::Vector3f& point : cloud.points) {
    point = without_error(point.cast<double>(), error).cast<float>();
  }
  return cloud;
}

const params::Table<AzimuthOptions>& azimuth_table() {
  using O = AzimuthOptions;
  static const params::Table<O> table = {
      params::number("max_distance_m", &O::max_distance_m, {1e-6, 1e6},
                     "Maximum distance between corresponding points."),
      params::integer("points", &O::points, {30, 100000000},
                      "Number of points of the sensor, divided equally among the scenes and evenly "
                      "spaced in each scan."),
      params::integer("normal_neighbours", &O::normal_neighbours, {3, 1000},
                      "Number of neighbours from which a normal is computed."),
      params::number("max_normal_angle_deg", &O::max_normal_angle_deg, {0.0, 90.0},
                     "Maximum angle between the normals of corresponding points."),
      params::number("direction_balance", &O::direction_balance, {0.0, 1.0},
                     "Each of n points on surfaces of about the same direction is weighted by "
                     "n^-k, k being this."),
      params::number("kernel_width_m", &O::kernel_width_m, {1e-6, 1e6},
                     "Larger residuals lose weight."),
      params::number("surface_size_m", &O::surface_size_m, {0.01, 1e6},
                     "Points of about the same direction in a cell of this edge are one surface, "
                     "whose errors are not independent."),
      params::number("prior_std_deg", &O::prior_std_deg, {1e-6, 90.0},
                     "Prior standard deviation of the error: of sine and cosine about 0, and of "
                     "the slope for an elevation of one radian.")
          .formerly("expected_error_deg"),
      params::integer("max_iterations", &O::max_iterations, {1, 10000},
                      "Maximum number of iterations."),
  };
  return table;
}

double AzimuthCalibration::significance() const {
  // With few surfaces, the gradients sum to zero for any error, so their scatter vanishes.
  constexpr double kMinSurfaces = 10.0;
  if (surfaces < kMinSurfaces) return 0.0;
  const Eigen::Vector3d sizes(error.sine_rad, error.cosine_rad, error.slope);
  return std::sqrt(std::max(0.0, sizes.dot(guarded_inverse<3>(covariance) * sizes) / 3.0));
}

AzimuthCalibration calibrate_azimuth(const std::vector<AzimuthView>& views,
                                     const AzimuthOptions& options) {
  Problem problem(views, options);
  AzimuthCalibration result;
  problem.linearise();
  result.rmse_before_m = problem.rmse_m();
  while (result.iterations < options.max_iterations && !result.converged) {
    result.converged = problem.step();
    ++result.iterations;
    problem.linearise();
  }
  problem.write_result(result);
  return result;
}

}  // namespace croon
