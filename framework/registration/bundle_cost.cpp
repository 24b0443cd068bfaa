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

void add(const PlanePatch& patch, const PlaneCost& cost, double bound, BundleCost& sum) {
  const double share = bound / (bound + cost.value);
  const double slope = share * share;
  const double curvature = -2.0 * slope * share / bound;
  sum.value += share * cost.value;
  for (std::size_t a = 0; a < cost.views.size(); ++a) {
    const PlaneCost::View& view_a = cost.views[a];
    const auto at_a = static_cast<Eigen::Index>(6 * patch.views[a].sensor);
    sum.gradient.segment<6>(at_a) += slope * view_a.gradient;
    sum.hessian.block<6, 6>(at_a, at_a) += slope * view_a.direct;
    for (std::size_t b = 0; b < cost.views.size(); ++b) {
      const PlaneCost::View& view_b = cost.views[b];
      const auto at_b = static_cast<Eigen::Index>(6 * patch.views[b].sensor);
      sum.hessian.block<6, 6>(at_a, at_b) +=
          curvature * view_a.gradient * view_b.gradient.transpose() -
          slope * view_a.to_plane * view_b.to_plane.transpose();
    }
  }
}

}  // namespace

double bundle_value(const std::vector<PlanePatch>& patches,
                    const std::vector<RigidTransform>& poses, double kernel_width) {
  const double bound = kernel_width * kernel_width;
  std::vector<double> parts(parts_of(patches.size()), 0.0);
  for_each_patch(patches, [&](std::size_t part, const PlanePatch& patch) {
    const double cost = plane_cost_value(patch, poses);
    parts[part] += cost * bound / (bound + cost);
  });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

BundleCost bundle_cost(const std::vector<PlanePatch>& patches,
                       const std::vector<RigidTransform>& poses, double kernel_width) {
  const auto size = static_cast<Eigen::Index>(6 * poses.size());
  BundleCost zero;
  zero.gradient = Eigen::VectorXd::Zero(size);
  zero.hessian = Eigen::MatrixXd::Zero(size, size);
  std::vector<BundleCost> parts(parts_of(patches.size()), zero);
  std::vector<PlaneCost> costs(parts.size());
  for_each_patch(patches, [&](std::size_t part, const PlanePatch& patch) {
    plane_cost(patch, poses, costs[part]);
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
