#include "framework/registration/pose_uncertainty.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "framework/base/statistics.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/observability.hpp"
#include "framework/registration/surface_key.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

constexpr std::size_t kMinContacts = 12;
constexpr int kDofCount = 6;

/// A source point on a surface of the target.
struct Contact {
  Eigen::Vector3d arm;                   ///< As in Correspondence.
  Eigen::Vector3d offset;                ///< Likewise.
  Eigen::Vector3d point;                 ///< The source point in the target's frame.
  Eigen::Vector3d of_target, of_source;  ///< Normals in the target's axes, on the same side.
  SurfaceKey surface;
  double delay_s;  ///< Measurement time of the source point minus that of the target point.
  bool is_grazed;  ///< Whether a sensor sees its surface at a grazing angle.
  /// The breadth of the line formed by the neighbours of one of the points, the minimum of the two;
  /// infinite if neither neighbourhood is a line.
  double line_breadth_m;
};

/// As in Contact, for one point.
double line_breadth_m(const LocalShape& shape, double line_breadth_ratio) {
  return shape.breadth_m < line_breadth_ratio * shape.length_m
             ? shape.breadth_m
             : std::numeric_limits<double>::infinity();
}

/// The contacts of two clouds at a pose, in the order of the source's points.
class ContactFinder {
 public:
  ContactFinder(const Cloud& target, const Cloud& source, const UncertaintyOptions& options)
      : target_(target),
        source_(source),
        options_(options),
        tree_(target.kd_tree()),
        target_normals_(target.normals(options.normal_neighbours)),
        source_normals_(source.normals(options.normal_neighbours)) {
    if (options.motion_covariance.isZero(0.0)) return;
    target_times_ = times_s(target.with_channels());
    source_times_ = times_s(source.with_channels());
    const double reference_s = span_of(target_times_).middle_s();
    require_near(target_times_, reference_s);
    require_near(source_times_, reference_s);
  }

  /// The contacts of at most `max_points` points, evenly spaced in the source.
  std::vector<Contact> contacts(const RigidTransform& T, std::size_t max_points) const {
    std::vector<Contact> found;
    const std::size_t size = source_.points().size();
    const std::size_t count = std::min(size, max_points);
    Contact contact;
    for (std::size_t i = 0; i < count; ++i) {
      const auto index = static_cast<int>(evenly_spaced_index(i, size, count));
      if (find(index, T, contact)) found.push_back(contact);
    }
    return found;
  }

 private:
  bool find(int index, const RigidTransform& T, Contact& contact) const {
    contact.arm = T.rotation * source_.points()[index].cast<double>();
    const Eigen::Vector3d point = contact.arm + T.translation;
    contact.point = point;
    const Neighbour nearest =
        tree_.nearest(point.cast<float>(), static_cast<float>(options_.max_distance_m));
    if (!nearest) return false;
    const LocalShape target_shape = target_normals_.at(nearest.index);
    const LocalShape source_shape = source_normals_.at(index);
    contact.of_target = target_shape.normal.cast<double>();
    contact.of_source = T.rotation * source_shape.normal.cast<double>();
    if (contact.of_target.isZero() || contact.of_source.isZero()) return false;
    if (contact.of_target.dot(contact.of_source) < 0.0) contact.of_source *= -1.0;
    contact.offset = point - target_.points()[nearest.index].cast<double>();
    contact.surface = surface_key(point, contact.of_target, options_.surface_size_m);
    contact.delay_s = source_times_.empty()
                          ? 0.0
                          : source_times_.at(static_cast<std::size_t>(index)) -
                                target_times_.at(static_cast<std::size_t>(nearest.index));
    constexpr double kGrazing = 0.5;  // The cosine of 60 degrees.
    contact.is_grazed =
        std::abs(contact.of_target.dot(point)) < kGrazing * point.norm() ||
        std::abs(contact.of_source.dot(contact.arm)) < kGrazing * contact.arm.norm();
    contact.line_breadth_m = std::min(line_breadth_m(target_shape, options_.line_breadth_ratio),
                                      line_breadth_m(source_shape, options_.line_breadth_ratio));
    return true;
  }

  const Cloud& target_;
  const Cloud& source_;
  const UncertaintyOptions& options_;
  const KdTree& tree_;
  const Normals& target_normals_;
  const Normals& source_normals_;
  std::vector<double> target_times_, source_times_;  ///< Empty if the motion is known.
};

/// The cost of contacts to second order.
struct Quadratic {
  Vector6d gradient = Vector6d::Zero();
  Matrix6d hessian = Matrix6d::Zero();  ///< With the curvature of the robust kernel.
  /// Of contacts whose normals are evidence: along the mean of the two normals,
  Matrix6d information = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();   ///< and along half of their difference.
  Vector6d grazed = Vector6d::Zero();  ///< The change of the gradient per metre of grazing error.
  /// The change of the gradient per rad/s about each axis of the target and per m/s along it.
  Matrix6d moved = Matrix6d::Zero();

  void add(const Quadratic& other) {
    gradient += other.gradient;
    hessian += other.hessian;
    information += other.information;
    noise += other.noise;
    grazed += other.grazed;
    moved += other.moved;
  }
};

/// Half of `weight * rho(r^T Omega r)` with Omega of Generalized-ICP, which weights a distance
/// across two parallel planes by one, and rho of Geman and McClure. Distances across surfaces have
/// the standard deviation `noise_m`.
Quadratic quadratic_of(const Contact& contact, double weight, double kernel_width_m,
                       double noise_m) {
  constexpr double kEpsilon = 0.001;  // The variance across a surface over the one along it.
  const Eigen::Vector3d &a = contact.of_target, &b = contact.of_source;
  const Eigen::Matrix3d Omega = plane_to_plane_information(a, b, kEpsilon);
  const Eigen::Matrix<double, 3, 6> J = point_jacobian(contact.arm);
  const Eigen::Matrix<double, 3, 6> OJ = Omega * J;
  const Vector6d slope = OJ.transpose() * contact.offset;
  const double inverse_width = 1.0 / (kernel_width_m * kernel_width_m);
  const double share = 1.0 / (1.0 + inverse_width * contact.offset.dot(Omega * contact.offset));
  const double w = weight * share * share;
  // The derivative of the gradient with respect to the offset, including the kernel's curvature.
  const Eigen::Matrix<double, 6, 3> by_offset =
      w * OJ.transpose() -
      (4.0 * w * share * inverse_width) * (slope * (Omega * contact.offset).transpose());
  Quadratic sums;
  sums.gradient = w * slope;
  sums.hessian = by_offset * J;
  if (contact.delay_s != 0.0) {
    sums.moved = contact.delay_s * (by_offset * point_jacobian(contact.point));
  }
  if (contact.is_grazed) sums.grazed = by_offset * a;
  // The noise rotates both normals alike about a line that is no broader than the noise.
  if (contact.line_breadth_m < noise_m) return sums;
  const Eigen::Vector3d normal = (a + b).normalized();
  const double along = w * normal.dot(Omega * normal);
  const Vector6d mean = plane_jacobian(contact.arm, normal);
  const Vector6d half = 0.5 * plane_jacobian(contact.arm, a - b);
  sums.information = along * (mean * mean.transpose());
  sums.noise = along * (half * half.transpose());
  return sums;
}

/// The prior information about any pose, in the units of the contacts' Hessian: information times
/// the variance of a residual, the square of `noise_m`.
Matrix6d prior_information(double noise_m) {
  return (noise_m * noise_m * unknown_variances().cwiseInverse()).asDiagonal();
}

/// `F^-1 H` by the eigenvectors of `F v = lambda H v`, with each lambda at least 1/4: in a weakly
/// constrained direction F consists of noise, may be negative, and would dominate all others.
Matrix6d bounded_ratio(const Matrix6d& F, const Matrix6d& H) {
  constexpr double kMinRatio = 0.25;  // In ordinary scenes 0.4 to 1.2.
  const Matrix6d L = guarded_inverse<6>(H).llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(symmetric<6>(L.transpose() * F * L));
  const Matrix6d V = L * solver.eigenvectors();  // V^T H V is the identity.
  return V * solver.eigenvalues().cwiseMax(kMinRatio).cwiseInverse().asDiagonal() * V.inverse();
}

/// The quadratic model of all contacts at a pose.
class ContactModel {
 public:
  ContactModel(const ContactFinder& finder, const RigidTransform& T,
               const UncertaintyOptions& options)
      : finder_(finder), pose_(T), options_(options) {
    constexpr std::size_t kMaxContacts = 20000;
    const std::vector<Contact> contacts = finder.contacts(T, kMaxContacts);
    count_ = contacts.size();
    DirectionCounts counts{};
    for (const Contact& contact : contacts) ++counts.at(contact.surface.second);
    weights_ = direction_weights(counts, options.direction_balance);
    std::vector<double> across_m;
    for (const Contact& contact : contacts) {
      across_m.push_back(std::abs(contact.of_target.dot(contact.offset)));
    }
    constexpr double kStdOfMedian = 1.4826;  // Standard deviation over median absolute deviation.
    if (!across_m.empty()) noise_m_ = kStdOfMedian * median(std::move(across_m));
    for (const Contact& contact : contacts) {
      const Quadratic one = quadratic(contact);
      surfaces_[contact.surface].add(one);
      all_.add(one);
    }
  }

  std::size_t count() const { return count_; }
  /// The standard deviation of the distances across surfaces.
  double noise_m() const { return noise_m_; }
  const Quadratic& all() const { return all_; }

  /// The jackknife over surfaces: the sum of the squared steps of the pose when one surface is left
  /// out.
  Matrix6d jackknife() const {
    Matrix6d sum = Matrix6d::Zero();
    for (const auto& [key, surface] : surfaces_) {
      const Vector6d step = guarded_inverse<6>(all_.hessian - surface.hessian) * surface.gradient;
      sum += step * step.transpose();
    }
    return sum;
  }

  /// The step of the pose if grazed surfaces are off by the noise.
  Vector6d grazing_step() const {
    return noise_m_ * (guarded_inverse<6>(all_.hessian) * all_.grazed);
  }

  /// The covariance of the step of the pose due to the uncertain motion.
  Matrix6d covariance_of_motion() const {
    const Matrix6d steps = guarded_inverse<6>(all_.hessian) * all_.moved;
    return steps * options_.motion_covariance * steps.transpose();
  }

  /// The ratio by which a pose moves farther than with constant contacts: `F^-1 H` of the Hessian H
  /// with constant contacts and F from differences of gradients with new contacts.
  Matrix6d stretch() const {
    constexpr std::size_t kMaxContacts = 4000;
    constexpr double kStep_rad = 0.0005, kStep_m = 0.01;
    Matrix6d same = prior_information(noise_m_);
    for (const Contact& contact : finder_.contacts(pose_, kMaxContacts)) {
      same += quadratic(contact).hessian;
    }
    Matrix6d found;
    for (int i = 0; i < kDofCount; ++i) {
      const double step = i < 3 ? kStep_rad : kStep_m;
      found.col(i) =
          (gradient_at(i, step, kMaxContacts) - gradient_at(i, -step, kMaxContacts)) / (2.0 * step);
    }
    return bounded_ratio(found, same);
  }

 private:
  Quadratic quadratic(const Contact& contact) const {
    return quadratic_of(contact, weights_.at(contact.surface.second), options_.kernel_width_m,
                        noise_m_);
  }

  Vector6d gradient_at(int dof, double step, std::size_t max_points) const {
    Vector6d sum = Vector6d::Zero();
    for (const Contact& contact :
         finder_.contacts(moved(pose_, step * Vector6d::Unit(dof)), max_points)) {
      sum += quadratic(contact).gradient;
    }
    return sum;
  }

  const ContactFinder& finder_;
  const RigidTransform& pose_;
  const UncertaintyOptions& options_;
  std::size_t count_ = 0;
  double noise_m_ = 0.0;
  std::array<double, kDirectionBins> weights_{};
  std::map<SurfaceKey, Quadratic> surfaces_;
  Quadratic all_;
};

/// Sets the observability of each degree of freedom, and adds the variance of an unknown pose to
/// those that only noise constrains.
void judge_dofs(const Quadratic& all, double noise_m, const UncertaintyOptions& options,
                PoseCovariance& covariance) {
  const auto held = dof_constraints(all.information, all.noise, prior_information(noise_m),
                                    options.weak_ratio, options.unobservable_ratio);
  for (std::size_t dof = 0; dof < held.size(); ++dof) {
    const auto& [word, motion] = held[dof];
    covariance.dofs[dof] = word;
    if (word != Observability::unobservable) continue;
    covariance.matrix +=
        unknown_variances()(static_cast<Eigen::Index>(dof)) * (motion * motion.transpose());
  }
}

}  // namespace

PoseCovariance pose_uncertainty(const Cloud& target, const Cloud& source,
                                const RigidTransform& T_target_source,
                                const UncertaintyOptions& options) {
  PoseCovariance covariance;
  covariance.matrix = unknown_variances().asDiagonal();
  covariance.dofs.fill(Observability::unobservable);
  if (target.empty() || source.empty()) return covariance;
  const ContactFinder finder(target, source, options);
  const ContactModel model(finder, T_target_source, options);
  if (model.count() < kMinContacts) return covariance;
  Matrix6d matrix = options.std_scale * options.std_scale * model.jackknife();
  const Vector6d grazing = options.grazing_error_ratio * model.grazing_step();
  matrix += grazing * grazing.transpose();
  if (options.follows_contacts) {
    const Matrix6d stretch = model.stretch();
    matrix = stretch * matrix * stretch.transpose();
  }
  // All contacts move with the car, and the pose follows them, so this is not stretched.
  matrix += model.covariance_of_motion();
  covariance.matrix = symmetric<6>(matrix);
  judge_dofs(model.all(), model.noise_m(), options, covariance);
  covariance.matrix = bounded_covariance(covariance.matrix);
  return covariance;
}

}  // namespace croon
