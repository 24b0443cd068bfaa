#include "framework/registration/bundle_cost.hpp"

#include <algorithm>

#include "framework/base/threads.hpp"

namespace croon {
namespace {

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

/// A six-dimensional unknown of a patch: its derivatives and its position among all unknowns.
struct PatchUnknown {
  const PlaneCost::Part* part;
  Eigen::Index at;
};

/// Adds `b c / (b + c)` for the cost c of a patch and the bound b, with its derivatives.
void add(const PlanePatch& patch, const PlaneCost& cost, double bound, BundleCost& sum) {
  const double share = bound / (bound + cost.value);
  const double slope = share * share;
  const double curvature = -2.0 * slope * share / bound;
  sum.value += share * cost.value;
  std::vector<PatchUnknown> unknowns;
  for (std::size_t k = 0; k < cost.views.size(); ++k) {
    unknowns.push_back({&cost.views[k], static_cast<Eigen::Index>(6 * patch.views[k].sensor)});
  }
  if (!cost.view_velocity.empty()) {
    const Eigen::Index at = sum.gradient.size() - 6;
    for (std::size_t k = 0; k < cost.views.size(); ++k) {
      const Matrix6d mixed = slope * cost.view_velocity[k];
      sum.hessian.block<6, 6>(unknowns[k].at, at) += mixed;
      sum.hessian.block<6, 6>(at, unknowns[k].at) += mixed.transpose();
    }
    unknowns.push_back({&cost.velocity, at});
  }
  for (const PatchUnknown& a : unknowns) {
    sum.gradient.segment<6>(a.at) += slope * a.part->gradient;
    sum.hessian.block<6, 6>(a.at, a.at) += slope * a.part->direct;
    for (const PatchUnknown& b : unknowns) {
      sum.hessian.block<6, 6>(a.at, b.at) +=
          curvature * a.part->gradient * b.part->gradient.transpose() -
          slope * a.part->to_plane * b.part->to_plane.transpose();
    }
  }
}

}  // namespace

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

BundleCost bundle_cost(const std::vector<PlanePatch>& patches, const RigState& state,
                       double kernel_width) {
  const auto size = static_cast<Eigen::Index>(6 * (state.poses.size() + (state.velocity ? 1 : 0)));
  BundleCost zero;
  zero.gradient = Eigen::VectorXd::Zero(size);
  zero.hessian = Eigen::MatrixXd::Zero(size, size);
  std::vector<BundleCost> parts(parts_of(patches.size()), zero);
  std::vector<PlaneCost> costs(parts.size());
  for_each_patch(patches, [&](std::size_t part, const PlanePatch& patch) {
    plane_cost(patch, state, costs[part]);
    add(patch, costs[part], kernel_width * kernel_width, parts[part]);
  });
  BundleCost sum = zero;
  for (const BundleCost& part : parts) {
    sum.value += part.value;
    sum.gradient += part.gradient;
    sum.hessian += part.hessian;
  }
  return sum;
}

}  // namespace croon
