#include "framework/registration/plane_cost.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "framework/base/threads.hpp"

namespace croon {
namespace {

/// The sums of a view's points in its sensor's frame, after their motion over their times.
PlanePatch::View displaced(const PlanePatch::View& view, const Twist& own) {
  const Eigen::Vector3d& u = own.linear_mps;
  const Eigen::Matrix3d turn = cross_matrix(own.angular_radps);
  PlanePatch::View after = view;
  // A point p moves by t d with d = u + w x p, so p p^T by t (d p^T + p d^T) + t^2 d d^T.
  const auto once = [&](const PointSums& timed) -> Eigen::Matrix3d {
    const Eigen::Matrix3d half = u * timed.sum.transpose() + turn * timed.products;
    return half + half.transpose();
  };
  const PointSums &timed = view.timed, &twice = view.timed_twice;
  const Eigen::Matrix3d across = turn * twice.sum * u.transpose();
  after.sums.sum += timed.weight * u + turn * timed.sum;
  after.sums.products += once(timed) + twice.weight * u * u.transpose() + across +
                         across.transpose() + turn * twice.products * turn.transpose();
  after.timed.sum += twice.weight * u + turn * twice.sum;
  after.timed.products += once(twice);
  return after;
}

/// The view of a patch at the velocity of `state`.
PlanePatch::View at_velocity(const PlanePatch::View& view, const RigState& state) {
  if (!state.velocity) return view;
  return displaced(view, velocity_in(state.poses[view.sensor].inverse(), *state.velocity));
}

/// The views of a patch at the velocity of a state, and the sums of all points in the common frame.
struct Joined {
  std::vector<PlanePatch::View> views;
  PointSums all;
};

Joined joined(const PlanePatch& patch, const RigState& state) {
  Joined result;
  result.views.reserve(patch.views.size());
  for (const PlanePatch::View& view : patch.views) {
    result.views.push_back(at_velocity(view, state));
    result.all.add(moved(result.views.back().sums, state.poses[view.sensor]));
  }
  return result;
}

/// The plane of a patch: its axes, the normal first; the square roots of the second derivatives
/// with respect to rotations about the two other axes and to the translation along the normal; and
/// the mean of its points.
struct FittedPlane {
  Eigen::Matrix3d axes;
  Eigen::Vector3d stiffness;
  Eigen::Vector3d centre;
};

/// How the rotational part of an unknown moves points: a rotation along arcs, or a rate of rotation
/// along straight lines.
enum class Turn { rotation, rate };

/// The derivatives with respect to a rotation about the origin of `T` and a translation, for points
/// with these sums.
PlaneCost::Part part_of(const PointSums& sums, const RigidTransform& T, const FittedPlane& plane,
                        Turn turn) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  const Vector3d n = plane.axes.col(0);
  const Matrix3d N = cross_matrix(n);
  // With arms a = R s and offsets o = a + t - c: sums of a, o, a a^T and a o^T.
  const Vector3d shift = T.translation - plane.centre;
  const Vector3d arm = T.rotation * sums.sum;
  const Vector3d offset = arm + sums.weight * shift;
  const Matrix3d arms = T.rotation * sums.products * T.rotation.transpose();
  const Matrix3d mixed = arms + arm * shift.transpose();
  // A point moves by (turn x a + d), its distance r = n . o by the row j = ((a x n)^T, n^T).
  const Vector3d arm_distance = mixed * n;  // sum of a r
  const double distance = offset.dot(n);    // sum of r
  PlaneCost::Part part;
  part.gradient << 2.0 * arm_distance.cross(n), 2.0 * distance * n;
  Matrix3d bend = Matrix3d::Zero();  // The second derivative of a rotated arm.
  if (turn == Turn::rotation) {
    bend = 0.5 * (n * arm_distance.transpose() + arm_distance * n.transpose());
    bend.diagonal().array() -= n.dot(arm_distance);
  }
  const Vector3d turned = -(N * arm);
  part.direct.topLeftCorner<3, 3>() = 2.0 * (N * arms * N.transpose() + bend);
  part.direct.topRightCorner<3, 3>() = 2.0 * turned * n.transpose();
  part.direct.bottomLeftCorner<3, 3>() = 2.0 * n * turned.transpose();
  part.direct.bottomRightCorner<3, 3>() = 2.0 * sums.weight * n * n.transpose();
  for (int i = 0; i < 2; ++i) {
    const Vector3d q = plane.axes.col(i + 1);
    part.to_plane.col(i) << 2.0 * (arm_distance.cross(q) - N * (mixed * q)),
        2.0 * (distance * q + n * offset.dot(q));
  }
  part.to_plane.col(2) << 2.0 * turned, 2.0 * sums.weight * n;
  part.to_plane *= plane.stiffness.cwiseInverse().asDiagonal();
  return part;
}

/// Patches are summed in parts of fixed size, so that no sum depends on the number of threads.
constexpr std::size_t kPatchesOfPart = 256;

std::size_t parts_of(std::size_t patches) {
  return (patches + kPatchesOfPart - 1) / kPatchesOfPart;
}

/// Calls `use(part, patch)` for each patch, the parts in parallel.
template <class Use>
void for_each_patch(const std::vector<PlanePatch>& patches, const Use& use) {
  for_each_in_parallel(parts_of(patches.size()), [&](std::size_t part) {
    const std::size_t end = std::min(patches.size(), (part + 1) * kPatchesOfPart);
    for (std::size_t i = part * kPatchesOfPart; i < end; ++i) use(part, patches[i]);
  });
}

/// Adds the derivatives of `b c / (b + c)` for the cost c of a patch and the bound b.
void add(const PlanePatch& patch, const PlaneCost& cost, double bound,
         const std::vector<Block>& poses, const Block& velocity, BlockSystem& sum) {
  const double share = bound / (bound + cost.value);
  const double slope = share * share;
  const double curvature = -2.0 * slope * share / bound;
  std::vector<std::pair<Block, const PlaneCost::Part*>> unknowns = {{velocity, &cost.velocity}};
  for (std::size_t k = 0; k < cost.views.size(); ++k) {
    const Block& pose = poses[patch.views[k].sensor];
    unknowns.emplace_back(pose, &cost.views[k]);
    if (!velocity) continue;
    const Matrix6d mixed = slope * cost.view_velocity[k];
    sum.add(pose, velocity, mixed);
    sum.add(velocity, pose, mixed.transpose());
  }
  for (const auto& [a, of_a] : unknowns) {
    sum.add(a, slope * of_a->gradient);
    sum.add(a, a, slope * of_a->direct);
    for (const auto& [b, of_b] : unknowns) {
      sum.add(a, b,
              curvature * of_a->gradient * of_b->gradient.transpose() -
                  slope * of_a->to_plane * of_b->to_plane.transpose());
    }
  }
}

}  // namespace

void PointSums::add(const Eigen::Vector3d& point, double point_weight) {
  weight += point_weight;
  sum += point_weight * point;
  products.noalias() += point_weight * point * point.transpose();
}

void PointSums::add(const PointSums& other) {
  weight += other.weight;
  sum += other.sum;
  products += other.products;
}

PointSums PointSums::scaled(double factor) const {
  return {factor * weight, factor * sum, factor * products};
}

Eigen::Matrix3d PointSums::scatter() const {
  if (!(weight > 0.0)) return Eigen::Matrix3d::Zero();
  return products - sum * (sum / weight).transpose();
}

PointSums moved(const PointSums& sums, const RigidTransform& T) {
  const Eigen::Vector3d arm = T.rotation * sums.sum;
  const Eigen::Matrix3d mixed = arm * T.translation.transpose();
  PointSums after;
  after.weight = sums.weight;
  after.sum = arm + sums.weight * T.translation;
  after.products = T.rotation * sums.products * T.rotation.transpose() + mixed + mixed.transpose() +
                   sums.weight * T.translation * T.translation.transpose();
  return after;
}

double min_eigenvalue(const Eigen::Matrix3d& scatter) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter, Eigen::EigenvaluesOnly);
  return std::max(solver.eigenvalues()(0), 0.0);
}

Matrix6d velocity_at(const Eigen::Vector3d& origin) {
  return adjoint({Eigen::Matrix3d::Identity(), -origin});
}

double plane_cost_value(const PlanePatch& patch, const RigState& state) {
  const Joined points = joined(patch, state);
  return std::max(min_eigenvalue(points.all.scatter()) - patch.own_cost, 0.0);
}

void plane_cost(const PlanePatch& patch, const RigState& state, PlaneCost& cost) {
  const Joined points = joined(patch, state);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(points.all.scatter());
  const Eigen::Vector3d& variances = solver.eigenvalues();
  const double minimum = std::max(variances(0), 0.0);
  cost.value = std::max(minimum - patch.own_cost, 0.0);
  cost.normal = solver.eigenvectors().col(0);
  cost.centre = points.all.sum / points.all.weight;
  // The plane rotates about the two other eigenvectors and moves along n. The second derivatives
  // with respect to these three are 2 (l_1 - l_0), 2 (l_2 - l_0) and 2 w; they do not mix.
  const double min_gap = 1e-12 * variances(2) + 1e-300;
  const Eigen::Vector3d curvature =
      2.0 * Eigen::Vector3d(std::max(variances(1) - minimum, min_gap),
                            std::max(variances(2) - minimum, min_gap), points.all.weight);
  const FittedPlane plane = {solver.eigenvectors(), curvature.cwiseSqrt(), cost.centre};
  cost.views.clear();
  cost.view_velocity.clear();
  cost.velocity = {};
  for (const PlanePatch::View& view : points.views) {
    const RigidTransform& T = state.poses[view.sensor];
    cost.views.push_back(part_of(view.sums, T, plane, Turn::rotation));
    if (!state.velocity) continue;
    // The velocity moves a point with time t like a step of the pose by t times the velocity.
    const Matrix6d from_common = velocity_at(T.translation);
    const PlaneCost::Part once = part_of(view.timed, T, plane, Turn::rotation);
    const PlaneCost::Part twice = part_of(view.timed_twice, T, plane, Turn::rate);
    cost.velocity.gradient += from_common.transpose() * once.gradient;
    cost.velocity.to_plane += from_common.transpose() * once.to_plane;
    cost.velocity.direct += from_common.transpose() * twice.direct * from_common;
    cost.view_velocity.emplace_back(once.direct * from_common);
  }
}

double bundle_value(const std::vector<PlanePatch>& patches, const RigState& state,
                    double kernel_width) {
  const double bound = kernel_width * kernel_width;
  std::vector<double> parts(parts_of(patches.size()), 0.0);
  for_each_patch(patches, [&](std::size_t part, const PlanePatch& patch) {
    const double cost = plane_cost_value(patch, state);
    parts[part] += cost * bound / (bound + cost);
  });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

BlockSystem bundle_cost(const std::vector<PlanePatch>& patches, const RigState& state,
                        double kernel_width, const std::vector<Block>& poses) {
  Eigen::Index size = 0;
  for (const Block& pose : poses) size += pose.size;
  const Block velocity = appended_block(state.velocity ? 6 : 0, size);
  BlockSystem sum = BlockSystem::zero(size);
  std::vector<BlockSystem> parts(parts_of(patches.size()), sum);
  std::vector<PlaneCost> costs(parts.size());
  for_each_patch(patches, [&](std::size_t part, const PlanePatch& patch) {
    plane_cost(patch, state, costs[part]);
    add(patch, costs[part], kernel_width * kernel_width, poses, velocity, parts[part]);
  });
  for (const BlockSystem& part : parts) {
    sum.gradient += part.gradient;
    sum.hessian += part.hessian;
  }
  return sum;
}

}  // namespace croon
