#include "framework/simulation/objects/barriers.hpp"

#include "framework/simulation/draws.hpp"
#include "framework/simulation/objects/along_path.hpp"

namespace croon::simulation {
namespace {

constexpr double kFoot_m = -0.3;

}  // namespace

Mesh make_wall(const Path& path, double height_m, double thickness_m, Material material) {
  const double half_m = 0.5 * thickness_m;
  Mesh mesh;
  add_loft(mesh, rings_along(path, box_profile({-half_m, kFoot_m}, {half_m, height_m})), material);
  return mesh;
}

Mesh make_garden_wall(const Path& path, double height_m, Rng& rng) {
  const Material material = pick<Material>({Material::brick, Material::plaster}, rng);
  const double pillars_m = rng.uniform(2.5, 4.0);
  const double half_m = rng.uniform(0.09, 0.14);
  const double coping_m = rng.uniform(0.05, 0.09);
  // The coping lies a hand below the tops of the pillars.
  const double low_m = height_m - 0.1 - coping_m;
  const Profile coping = box_profile({-half_m - 0.03, low_m}, {half_m + 0.03, low_m + coping_m});
  Mesh mesh;
  add_loft(mesh, rings_along(path, box_profile({-half_m, kFoot_m}, {half_m, low_m})), material);
  add_loft(mesh, rings_along(path, coping), Material::concrete);
  for (const PathPlace& place : places_along(path, pillars_m)) {
    const double pillar_m = half_m + 0.06;
    add_pillar(mesh, place, {pillar_m, pillar_m}, kFoot_m, height_m, material);
  }
  return mesh;
}

Mesh make_jersey_barrier(const Path& path) {
  // The New Jersey profile of 32 inches: foot, slopes of 55 and 84 degrees. It begins at a place
  // that sees all corners, as the ends of a loft want.
  const Profile profile = {{0.0, kFoot_m}, {0.3, kFoot_m}, {0.3, 0.08},
                           {0.17, 0.33},   {0.08, 0.8},    {-0.08, 0.8},
                           {-0.17, 0.33},  {-0.3, 0.08},   {-0.3, kFoot_m}};
  Mesh mesh;
  add_loft(mesh, rings_along(path, profile), Material::concrete);
  return mesh;
}

}  // namespace croon::simulation
