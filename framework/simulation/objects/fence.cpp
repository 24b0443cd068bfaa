#include "framework/simulation/draws.hpp"
#include "framework/simulation/objects/along_path.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A sort of fence.
struct FenceSort {
  Material material = Material::metal;
  Span bar_m;  ///< Width of a bar.
  Span gap_m;  ///< From one bar to the next.
  double half_post_m = 0.03;
};

/// Bars, pickets and boards.
const std::vector<FenceSort>& fence_sorts() {
  static const std::vector<FenceSort> sorts = {{Material::metal, {0.02, 0.03}, {0.1, 0.16}, 0.03},
                                               {Material::wood, {0.07, 0.1}, {0.06, 0.2}, 0.05},
                                               {Material::wood, {0.12, 0.16}, {0.01, 0.04}, 0.05}};
  return sorts;
}

/// A bar as a flat strip before the rails: rays see its width and not its thickness.
void add_bar(Mesh& mesh, const PathPlace& place, double half_m, double height_m,
             Material material) {
  constexpr double kOut_m = 0.022;
  constexpr double kFoot_m = 0.06;
  const Vector3d middle = place.foot + kOut_m * Vector3d(-place.along.y(), place.along.x(), 0.0);
  const Vector3d low = middle + kFoot_m * Vector3d::UnitZ();
  const Vector3d high = middle + height_m * Vector3d::UnitZ();
  const Vector3d half = half_m * place.along;
  mesh.add_quad(low - half, low + half, high + half, high - half, material);
}

}  // namespace

Mesh make_fence(const Path& path, double height_m, Rng& rng) {
  const FenceSort& sort = pick(fence_sorts(), rng);
  const double bar_m = rng.uniform(sort.bar_m.from, sort.bar_m.to);
  const double gap_m = rng.uniform(sort.gap_m.from, sort.gap_m.to);
  const double posts_m = rng.uniform(2.0, 2.5);
  Mesh mesh;
  for (const double rail_m : {0.2 * height_m, 0.85 * height_m}) {
    const Profile rail = box_profile({-0.02, rail_m - 0.03}, {0.02, rail_m + 0.03});
    add_loft(mesh, rings_along(path, rail), sort.material);
  }
  for (const PathPlace& place : places_along(path, posts_m)) {
    add_pillar(mesh, place, {sort.half_post_m, sort.half_post_m}, -0.3, height_m, sort.material);
  }
  for (const PathPlace& place : places_along(path, bar_m + gap_m)) {
    add_bar(mesh, place, 0.5 * bar_m, 0.97 * height_m, sort.material);
  }
  return mesh;
}

}  // namespace croon::simulation
