#include "framework/registration/joint_pair.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/params/values.hpp"
#include "framework/registration/direction_balance.hpp"
#include "framework/registration/icp_options.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/ground_candidates.hpp"
#include "framework/spatial/vehicle_sized.hpp"

namespace croon {
namespace {

/// The points of a scan that are used, evenly spaced and with normals, and their weights.
struct Sample {
  std::vector<int> indices;
  std::vector<int> patches;
  std::vector<double> weights;
};

/// The sample is the same in every iteration, so it is computed once.
std::shared_ptr<const Sample> sample_of(const Cloud& cloud, const JointOptions& options) {
  const std::string parameters =
      params::value_json(options.points) + " " + params::value_json(options.normal_neighbours) +
      " " + params::value_json(options.patch_m) + " " + params::value_json(options.patch_balance);
  return cloud.once<Sample>("joint_sample", parameters, [&] {
    auto sample = std::make_shared<Sample>();
    const Normals& normals = cloud.normals(options.normal_neighbours);
    const std::size_t size = cloud.points().size();
    const std::size_t count = std::min(size, static_cast<std::size_t>(options.points));
    for (std::size_t n = 0; n < count; ++n) {
      const auto i = static_cast<int>(evenly_spaced_index(n, size, count));
      if (!normals.at(i).normal.isZero()) sample->indices.push_back(i);
    }
    sample->patches =
        patches_of(cloud, sample->indices, options.normal_neighbours, options.patch_m);
    sample->weights = patch_weights(sample->patches, options.patch_balance);
    return sample;
  });
}

/// A point on a surface of the target, linearised.
struct JointTerm {
  PairVector J;  ///< Its three translational elements are the normal of the target's surface.
  double residual_m;
  int patch;
  double weight;          ///< Of the patch and the target point, without the kernel.
  double later_s;         ///< Time of the sensor's measurement after the target's.
  Eigen::Vector3d point;  ///< Of the target.

  Eigen::Vector3d normal() const { return J.segment<3>(kPairPose + 3); }
};

JointCell cell_of(const JointTerm& term) {
  return leaf_key(LeafGrid(kJointCell_m).leaf_of(term.point));
}

RobustKernel kernel_at(double max_distance_m, const JointOptions& options) {
  return {Kernel::geman_mcclure, std::max(options.kernel_width_m, max_distance_m / 4.0)};
}

/// The second derivative of the Geman-McClure kernel divided by its weight, which is the square of
/// `1 / (1 + r^2 / width^2)`: 1 for a residual of zero, negative for large ones.
double curvature_over_weight(double weight) { return 4.0 * std::sqrt(weight) - 3.0; }

/// Reduces the weight of the terms of a patch that is displaced as a whole, i.e. moves
/// independently.
void weigh_patches(std::vector<JointTerm>& terms, const JointView& view) {
  if (view.options.patch_kernel_m <= 0.0) return;
  struct Mean {
    double sum_m = 0.0, weight = 0.0;
  };
  const RobustKernel kernel = kernel_at(view.max_distance_m, view.options);
  const RobustKernel of_patch(Kernel::geman_mcclure,
                              std::max(view.options.patch_kernel_m, view.max_distance_m / 10.0));
  std::vector<Mean> means;
  for (const JointTerm& term : terms) {
    if (term.patch >= static_cast<int>(means.size())) means.resize(term.patch + 1);
    const double w = kernel.weight(term.residual_m * term.residual_m);
    means[term.patch].sum_m += w * term.residual_m;
    means[term.patch].weight += w;
  }
  for (JointTerm& term : terms) {
    const Mean& mean = means[term.patch];
    if (mean.weight <= 0.0) continue;
    const double mean_m = mean.sum_m / mean.weight;
    term.weight *= of_patch.weight(mean_m * mean_m);
  }
}

/// Linearises the residuals of the points of a source in one iteration.
class TermMaker {
 public:
  TermMaker(const JointScene::Source& source, const DeskewedTarget& target, const JointView& view)
      : scan_(source.scan),
        target_(target),
        velocity_(view.velocity),
        whole_velocity_(stepped(target.scene().removed, vector_of(view.velocity))),
        clock_offset_s_(view.state.clock_offsets_s[source.sensor]),
        pose_(motion_over(target.scene().removed, clock_offset_s_) *
              view.state.T_target_sensor[source.sensor]),
        normals_(source.scan.cloud->normals(view.options.normal_neighbours)),
        min_cosine_(std::cos(rad_from_deg(view.options.max_normal_angle_deg))),
        max_distance_m_(view.max_distance_m) {}

  /// Writes the term of point `index` of the source into `term`, except for its patch, with only
  /// the weight of the target point. Returns false if the point has no correspondence.
  bool make(int index, JointTerm& term) const {
    using Eigen::Vector3d;
    const double source_s = scan_.times_s[index] + clock_offset_s_ - target_.reference_s();
    const RigidTransform motion = motion_over(velocity_, source_s);
    const Vector3d turned = pose_.rotation * scan_.cloud->points()[index].cast<double>();
    const Vector3d q = motion * Vector3d(turned + pose_.translation);
    const Neighbour nearest = target_.nearest(q, max_distance_m_);
    if (!nearest) return false;
    const auto [p, n] = target_.surface(nearest.index);
    const Vector3d source_normal =
        motion.rotation * (pose_.rotation * normals_.at(index).normal.cast<double>());
    if (n.isZero() || n.dot(source_normal) < min_cosine_) return false;
    const double target_s = target_.time_s(nearest.index);
    term.residual_m = n.dot(q - p);
    term.weight = target_.weight(nearest.index);
    term.later_s = source_s - target_s;
    term.point = p;
    // The derivatives of exp(xi t) at small xi t: a scan rotates by a few degrees at most.
    term.J << (motion.rotation * turned).cross(n), n, source_s * q.cross(n) - target_s * p.cross(n),
        term.later_s * n,
        n.dot(whole_velocity_.angular_radps.cross(q) + whole_velocity_.linear_mps);
    return true;
  }

 private:
  const TimedScan& scan_;
  const DeskewedTarget& target_;
  const Twist& velocity_;
  Twist whole_velocity_;  ///< Including the velocity that an earlier step has removed.
  double clock_offset_s_;
  /// The sensor's pose, moved by the part of the motion that an earlier step has not removed
  /// because it did not correct the sensor's clock.
  RigidTransform pose_;
  const Normals& normals_;
  double min_cosine_;
  double max_distance_m_;
};

/// The terms of the corresponding points of `source`, in their order.
std::vector<JointTerm> terms_of(const JointScene::Source& source, const DeskewedTarget& target,
                                const JointView& view) {
  const TermMaker maker(source, target, view);
  const std::shared_ptr<const Sample> sample = sample_of(*source.scan.cloud, view.options);
  std::vector<JointTerm> terms;
  JointTerm term;
  for (std::size_t k = 0; k < sample->indices.size(); ++k) {
    if (!maker.make(sample->indices[k], term)) continue;
    term.patch = sample->patches[k];
    term.weight *= sample->weights[k];
    terms.push_back(term);
  }
  weigh_patches(terms, view);
  return terms;
}

/// Whether each point of a scan belongs to a vehicle-sized object; all false if no ground is found.
std::shared_ptr<const std::vector<bool>> vehicles_of(const Cloud& cloud) {
  constexpr int kForTheGround = 5000;
  return cloud.once<std::vector<bool>>("vehicles", [&] {
    const Points& points = cloud.points();
    Rng rng = cloud.rng("vehicles");
    const auto grounds =
        ground_candidates(evenly_spaced(points, kForTheGround), GroundCandidateOptions{}, rng);
    return std::make_shared<std::vector<bool>>(
        grounds.empty() ? std::vector<bool>(points.size(), false)
                        : is_vehicle_sized(points, grounds.front().plane, VehicleSize{}));
  });
}

}  // namespace

Matrix6d velocity_information(const JointScene& scene, const JointOptions& options) {
  constexpr double kMinStd = 1e-4;
  const double width_m = options.kernel_width_m;
  if (scene.velocity_covariance) {
    const Matrix6d min_covariance = Vector6d::Constant(kMinStd * kMinStd).asDiagonal();
    return width_m * width_m * guarded_inverse<6>(*scene.velocity_covariance + min_covariance);
  }
  return unknown_velocity_information(options);
}

Matrix6d unknown_velocity_information(const JointOptions& options) {
  const double width_m = options.kernel_width_m;
  Vector6d shares;
  shares << Eigen::Vector3d::Constant(width_m / options.velocity_std[1]),
      Eigen::Vector3d::Constant(width_m / options.velocity_std[0]);
  return shares.cwiseAbs2().asDiagonal();
}

JointView last_view(const JointState& state, const Twist& velocity, const JointOptions& options) {
  return {state, velocity, options.max_distances_m.back(), options};
}

DeskewedTarget::DeskewedTarget(const JointScene& scene, const Twist& velocity,
                               const JointOptions& options)
    : scene_(scene),
      velocity_(velocity),
      tree_(&scene.target.cloud->kd_tree()),
      normals_(scene.target.cloud->normals(options.normal_neighbours)),
      vehicle_weight_(options.vehicle_weight) {
  const Cloud& cloud = *scene.target.cloud;
  double max_square_s2m2 = 0.0;
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const double away_s = time_s(static_cast<int>(i));
    const double range_m2 = cloud.points()[i].squaredNorm();
    max_square_s2m2 = std::max(max_square_s2m2, away_s * away_s * range_m2);
  }
  max_time_times_range_sm_ = std::sqrt(max_square_s2m2);
  if (vehicle_weight_ < 1.0) vehicles_ = vehicles_of(cloud);
  if (!scene.target.times_s.empty()) span_ = span_of(scene.target.times_s);
  max_time_s_ = std::max(std::abs(span_.first_s - scene.reference_s),
                         std::abs(span_.last_s - scene.reference_s));
  if (!vector_of(velocity).isZero(0.0)) move_tree();
}

void DeskewedTarget::move_tree() {
  const Cloud& cloud = *scene_.target.cloud;
  tree_velocity_ = velocity_;
  const double step_s = (span_.last_s - span_.first_s) / kSteps;
  struct Motion {
    Eigen::Matrix3f rotation;
    Eigen::Vector3f translation;
  };
  std::vector<Motion> motions;
  motions.reserve(kSteps + 1);
  for (int step = 0; step <= kSteps; ++step) {
    const RigidTransform T =
        motion_over(velocity_, span_.first_s + step * step_s - scene_.reference_s);
    motions.push_back({T.rotation.cast<float>(), T.translation.cast<float>()});
  }
  const double steps_per_s = step_s > 0.0 ? 1.0 / step_s : 0.0;
  moved_points_.resize(cloud.points().size());
  for (std::size_t i = 0; i < moved_points_.size(); ++i) {
    // Half a step later, so that the conversion rounds to the nearest.
    const double steps = (scene_.target.times_s[i] - span_.first_s) * steps_per_s + 0.5;
    const Motion& motion = motions[static_cast<std::size_t>(steps)];
    moved_points_[i] = motion.rotation * cloud.points()[i] + motion.translation;
  }
  if (!moved_tree_) moved_tree_ = std::make_unique<KdTree>(cloud.kd_tree());
  moved_tree_->move_to(moved_points_);
  tree_ = moved_tree_.get();
}

void DeskewedTarget::set_velocity(const Twist& velocity, double max_shift_m) {
  velocity_ = velocity;
  const Twist change = stepped(velocity, -vector_of(tree_velocity_));
  const double shift_m = max_time_s_ * change.linear_mps.norm() +
                         max_time_times_range_sm_ * change.angular_radps.norm();
  if (shift_m > max_shift_m) move_tree();
}

Neighbour DeskewedTarget::nearest(const Eigen::Vector3d& query, double max_distance_m) const {
  return tree_->nearest(query.cast<float>(), static_cast<float>(max_distance_m));
}

DeskewedTarget::Surface DeskewedTarget::surface(int index) const {
  const RigidTransform motion = motion_over(velocity_, time_s(index));
  return {motion * scene_.target.cloud->points()[index].cast<double>(),
          motion.rotation * normals_.at(index).normal.cast<double>()};
}

PairEquations pair_equations(const JointScene::Source& source, const DeskewedTarget& target,
                             const JointView& view) {
  const RobustKernel kernel = kernel_at(view.max_distance_m, view.options);
  PairEquations sums;
  for (const JointTerm& term : terms_of(source, target, view)) {
    const double square = term.residual_m * term.residual_m;
    const double w = term.weight * kernel.weight(square);
    sums.information.selfadjointView<Eigen::Lower>().rankUpdate(term.J, w);
    sums.gradient += (w * term.residual_m) * term.J;
    sums.weighted_square_sum += w * square;
    sums.weight_sum += w;
    ++sums.correspondences;
  }
  sums.information.triangularView<Eigen::StrictlyUpper>() = sums.information.transpose();
  return sums;
}

PairAgreement pair_agreement(const JointScene::Source& source, const DeskewedTarget& target,
                             const JointView& view) {
  JointOptions options_without_patch_kernel = view.options;
  options_without_patch_kernel.patch_kernel_m = 0.0;
  const std::vector<JointTerm> terms =
      terms_of(source, target,
               {view.state, view.velocity, view.max_distance_m, options_without_patch_kernel});
  PairAgreement agreement;
  for (const JointTerm& term : terms) {
    const double widths = term.residual_m / view.options.kernel_width_m;
    agreement.points.push_back(
        {cell_of(term), term.normal(), term.weight * (1.0 / (1.0 + widths * widths) - 0.5)});
    agreement.later_s += term.later_s / static_cast<double>(terms.size());
  }
  return agreement;
}

std::map<JointCell, double> PairAgreement::by_cell(
    const std::optional<Eigen::Vector3d>& axis) const {
  std::map<JointCell, double> sums;
  for (const Point& point : points) {
    sums[point.cell] += (axis ? std::abs(axis->dot(point.normal)) : 1.0) * point.agreeing;
  }
  return sums;
}

std::map<JointCell, CellEquations> cell_equations(const JointScene::Source& source,
                                                  const DeskewedTarget& target,
                                                  const JointView& view) {
  const RobustKernel kernel = kernel_at(view.max_distance_m, view.options);
  std::map<JointCell, CellEquations> cells;
  for (const JointTerm& term : terms_of(source, target, view)) {
    CellEquations& sums = cells[cell_of(term)];
    const double square = term.residual_m * term.residual_m;
    const double w = term.weight * kernel.weight(square);
    sums.hessian +=
        (w * curvature_over_weight(kernel.weight(square))) * (term.J * term.J.transpose());
    sums.gradient += (w * term.residual_m) * term.J;
    ++sums.correspondences;
  }
  return cells;
}

}  // namespace croon
