#include "framework/simulation/objects/profiles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kPostFoot_m = -0.3;  ///< Depth of the feet of barriers below their path.

/// A type of fence.
struct FenceType {
  Material material = Material::metal;
  Span bar_m;  ///< Width of a bar.
  Span gap_m;  ///< Between bars.
  double half_post_m = 0.03;
};

/// Bars, pickets and boards.
const std::vector<FenceType>& fence_types() {
  static const std::vector<FenceType> types = {{Material::metal, {0.02, 0.03}, {0.1, 0.16}, 0.03},
                                               {Material::wood, {0.07, 0.1}, {0.06, 0.2}, 0.05},
                                               {Material::wood, {0.12, 0.16}, {0.01, 0.04}, 0.05}};
  return types;
}

/// Adds a bar as a flat strip in front of the rails; it has no thickness.
void add_bar(Mesh& mesh, const PathPoint& point, double half_m, double height_m,
             Material material) {
  constexpr double kOut_m = 0.022;
  constexpr double kAbove_m = 0.06;
  const Vector3d middle = point.position + kOut_m * point.left();
  const Vector3d low = middle + kAbove_m * Vector3d::UnitZ();
  const Vector3d high = middle + height_m * Vector3d::UnitZ();
  const Vector3d half = half_m * point.along;
  mesh.add_quad(low - half, low + half, high + half, high - half, material);
}

}  // namespace

Mesh make_wall(const Path& path, double height_m, double thickness_m, Material material) {
  const double half_m = 0.5 * thickness_m;
  Mesh mesh;
  add_loft(mesh, rings_along(path, box_profile({-half_m, kPostFoot_m}, {half_m, height_m})),
           material);
  return mesh;
}

Mesh make_garden_wall(const Path& path, double height_m, Rng& rng) {
  const Material material = pick<Material>({Material::brick, Material::plaster}, rng);
  const double pillars_m = rng.uniform(2.5, 4.0);
  const double half_m = rng.uniform(0.09, 0.14);
  const double coping_m = rng.uniform(0.05, 0.09);
  // The coping is 0.1 m below the tops of the pillars.
  const double low_m = height_m - 0.1 - coping_m;
  const Profile coping = box_profile({-half_m - 0.03, low_m}, {half_m + 0.03, low_m + coping_m});
  Mesh mesh;
  add_loft(mesh, rings_along(path, box_profile({-half_m, kPostFoot_m}, {half_m, low_m})), material);
  add_loft(mesh, rings_along(path, coping), Material::concrete);
  for (const PathPoint& point : points_along(path, pillars_m)) {
    const double pillar_m = half_m + 0.06;
    add_pillar(mesh, point, {pillar_m, pillar_m}, kPostFoot_m, height_m, material);
  }
  return mesh;
}

Mesh make_jersey_barrier(const Path& path) {
  // The New Jersey profile of 32 inches: foot, slopes of 55 and 84 degrees. All corners are visible
  // from the first one, so the ends of the loft are correct although the profile is not convex.
  const Profile profile = {{0.0, kPostFoot_m}, {0.3, kPostFoot_m}, {0.3, 0.08},
                           {0.17, 0.33},       {0.08, 0.8},        {-0.08, 0.8},
                           {-0.17, 0.33},      {-0.3, 0.08},       {-0.3, kPostFoot_m}};
  Mesh mesh;
  add_loft(mesh, rings_along(path, profile), Material::concrete);
  return mesh;
}

Mesh make_fence(const Path& path, double height_m, Rng& rng) {
  const FenceType& type = pick(fence_types(), rng);
  const double bar_m = draw(rng, type.bar_m);
  const double gap_m = draw(rng, type.gap_m);
  const double posts_m = rng.uniform(2.0, 2.5);
  Mesh mesh;
  for (const double rail_m : {0.2 * height_m, 0.85 * height_m}) {
    const Profile rail = box_profile({-0.02, rail_m - 0.03}, {0.02, rail_m + 0.03});
    add_loft(mesh, rings_along(path, rail), type.material);
  }
  for (const PathPoint& point : points_along(path, posts_m)) {
    add_pillar(mesh, point, {type.half_post_m, type.half_post_m}, kPostFoot_m, height_m,
               type.material);
  }
  for (const PathPoint& point : points_along(path, bar_m + gap_m)) {
    add_bar(mesh, point, 0.5 * bar_m, 0.97 * height_m, type.material);
  }
  return mesh;
}

Mesh make_guard_rail(const Path& path, Rng& rng) {
  const double posts_m = pick<double>({2.0, 4.0}, rng);
  const double top_m = rng.uniform(0.73, 0.75);
  constexpr double kNear_m = 0.06;  // The valleys of the beam, at the posts.
  constexpr double kFar_m = 0.14;   // The crests of the beam.
  // The corners of the beam: distance from the path and height above the lower edge. Sheet metal is
  // a single surface.
  const Profile beam = {{kNear_m, 0.0}, {kFar_m, 0.06}, {kFar_m, 0.1},  {kNear_m, 0.155},
                        {kFar_m, 0.21}, {kFar_m, 0.25}, {kNear_m, 0.31}};
  Mesh mesh;
  for (const double side : {-1.0, 1.0}) {
    Profile raised;
    for (const Eigen::Vector2d& corner : beam) {
      raised.emplace_back(side * corner.x(), corner.y() + top_m - 0.31);
    }
    add_strip(mesh, rings_along(path, raised), Material::metal);
  }
  for (const PathPoint& point : points_along(path, posts_m)) {
    add_pillar(mesh, point, {0.03, kNear_m}, kPostFoot_m, top_m - 0.04, Material::metal);
  }
  return mesh;
}

}  // namespace croon::simulation
