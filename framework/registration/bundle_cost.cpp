#include "framework/registration/bundle_cost.hpp"

#include <algorithm>
#include <utility>

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
