#include "framework/simulation/draws.hpp"
#include "framework/simulation/objects/along_path.hpp"

namespace croon::simulation {

Mesh make_guard_rail(const Path& path, Rng& rng) {
  const double posts_m = pick<double>({2.0, 4.0}, rng);
  const double top_m = rng.uniform(0.73, 0.75);
  constexpr double kNear_m = 0.06;  // The valleys of the beam, at the posts.
  constexpr double kFar_m = 0.14;   // Its crests.
  // From the lower edge of the beam: how far out and how high its corners are. Sheet metal is a
  // single skin.
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
  for (const PathPlace& place : places_along(path, posts_m)) {
    add_pillar(mesh, place, {0.03, kNear_m}, -0.3, top_m - 0.04, Material::metal);
  }
  return mesh;
}

}  // namespace croon::simulation
