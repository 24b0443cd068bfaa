// Every kind of scene, over many seeds: whole meshes, space for the car, and the features of its
// kind.
#include "framework/simulation/scenes/scene.hpp"

#include <gtest/gtest.h>

#include "framework/simulation/ray_caster.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr CarBody kSceneCar = {4.7, 1.9};
constexpr std::uint64_t kSceneSeeds = 12;

World scene(SceneKind kind, std::uint64_t seed) {
  return make_scene(kind, kSceneCar, StreamKey(seed).with("scene test"));
}

/// The vertices of all but the car, in the car's frame.
Points seen_from_car(const World& world) {
  const RigidTransform T_car_world = world.car.T_world_body.inverse();
  Points points = transformed(world.fixed.vertices, T_car_world);
  for (const Body& body : world.bodies) {
    const Points own = transformed(body.mesh.vertices, T_car_world * body.T_world_body);
    points.insert(points.end(), own.begin(), own.end());
  }
  return points;
}

/// The range from a point in the car's frame along a direction in it.
double range_m(const RayCaster& caster, const World& world, const Vector3d& from,
               const Vector3d& along) {
  const RigidTransform& T = world.car.T_world_body;
  return caster.cast({{T * from, T.rotation * along, 0.0}}, 0.0, 100.0).front().range_m;
}

/// The least range to an object beside the car at any height up to 3 m: a truck has gaps, and a
/// tank is widest at its middle.
double beside_m(const RayCaster& caster, const World& world, const Vector3d& side) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double height_m = 0.5; height_m < 3.0; height_m += 0.25) {
    for (double x_m = -2.0; x_m <= 2.0; x_m += 1.0) {
      least_m = std::min(least_m, range_m(caster, world, {x_m, 0.0, height_m}, side));
    }
  }
  return least_m;
}

class EveryKind : public testing::TestWithParam<std::size_t> {
 protected:
  SceneKind kind() const { return static_cast<SceneKind>(GetParam()); }
};

TEST_P(EveryKind, IsWholeAndFollowsFromItsKeyAlone) {
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    const World world = scene(kind(), seed);
    const World again = scene(kind(), seed);
    EXPECT_TRUE(test::are_same(world.fixed, again.fixed));
    test::expect_whole(world.fixed);
    ASSERT_EQ(world.bodies.size(), again.bodies.size());
    std::size_t triangles = world.fixed.triangles.size();
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      EXPECT_TRUE(test::are_same(world.bodies[i].mesh, again.bodies[i].mesh));
      test::expect_whole(world.bodies[i].mesh);
      triangles += world.bodies[i].mesh.triangles.size();
    }
    EXPECT_LT(triangles, 220000U);
    EXPECT_TRUE(world.car.mesh.triangles.empty());
    EXPECT_NE(world.fixed.vertices, scene(kind(), seed + 100).fixed.vertices);
  }
}

TEST_P(EveryKind, LeavesTheCarItsSpace) {
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    for (const Eigen::Vector3f& point : seen_from_car(scene(kind(), seed))) {
      const bool is_beside_it = point.z() <= 0.3F || point.z() >= 2.5F;
      EXPECT_TRUE(is_beside_it || !test::is_in_car(kSceneCar, point))
          << "seed " << seed << ": " << point.transpose();
    }
  }
}

TEST_P(EveryKind, HasGroundUnderTheCar) {
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    const auto world = std::make_shared<const World>(scene(kind(), seed));
    const RayCaster caster(world, {});
    for (const double x_m : {-1.3, 0.0, 1.3}) {
      EXPECT_NEAR(range_m(caster, *world, {x_m, 0.0, 1.0}, -Vector3d::UnitZ()), 1.0, 0.1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, testing::Range(std::size_t{0}, kSceneKinds.size()),
                         [](const auto& kind) { return kSceneKinds[kind.param].name; });

/// The middles of the triangles of houses and garden walls near the car, and a world without them.
struct Masonry {
  std::vector<Vector3d> middles;
  std::shared_ptr<World> others = std::make_shared<World>();
};

Masonry take_masonry_out(const World& world) {
  Masonry masonry;
  const Mesh& mesh = world.fixed;
  masonry.others->fixed.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (mesh.materials[i] != Material::brick && mesh.materials[i] != Material::plaster) {
      masonry.others->fixed.add_triangle(a, b, c, mesh.materials[i]);
      continue;
    }
    const Eigen::Vector3f sum = mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c];
    if (sum.head<2>().norm() < 3.0F * 50.0F) masonry.middles.emplace_back(sum.cast<double>() / 3.0);
  }
  return masonry;
}

TEST(Roads, AreFreeOfHouses) {
  for (const SceneKind kind : {SceneKind::urban, SceneKind::suburban, SceneKind::crossing}) {
    for (std::uint64_t seed = 0; seed < kSceneSeeds / 2; ++seed) {
      const Masonry masonry = take_masonry_out(scene(kind, seed));
      ASSERT_FALSE(masonry.middles.empty());
      // From below, the ground is what a ray meets first.
      std::vector<Ray> rays;
      for (const Vector3d& middle : masonry.middles) {
        rays.push_back({{middle.x(), middle.y(), -20.0}, Vector3d::UnitZ(), 0.0});
      }
      int on_road = 0;
      for (const Hit& hit : RayCaster(masonry.others, {}).cast(rays, 0.0, 100.0)) {
        const bool is_road = hit.material == Material::asphalt || hit.material == Material::marking;
        if (hit.is_there() && is_road) ++on_road;
      }
      EXPECT_EQ(on_road, 0) << row_of(kind).name << ", seed " << seed;
    }
  }
}

TEST(HardKinds, HaveTheFeaturesOfTheirKind) {
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    for (const Eigen::Vector3f& point : seen_from_car(scene(SceneKind::empty, seed))) {
      if (point.head<2>().norm() > 20.0F) continue;
      EXPECT_LT(point.z(), 1.5F) << "empty, seed " << seed;
    }
    for (const SceneKind kind : {SceneKind::narrow, SceneKind::corridor, SceneKind::blocked}) {
      const auto world = std::make_shared<const World>(scene(kind, seed));
      const RayCaster caster(world, {});
      const double left_m = beside_m(caster, *world, Vector3d::UnitY());
      const double right_m = beside_m(caster, *world, -Vector3d::UnitY());
      const double half_m = 0.5 * kSceneCar.width_m;
      const char* const name = row_of(kind).name;
      if (kind == SceneKind::blocked) {
        // At most 0.9 m to the mirrors, which stand out by up to 0.3 m.
        EXPECT_LT(std::min(left_m, right_m), half_m + 1.2) << name << ", seed " << seed;
      } else {
        const double most_m = kind == SceneKind::narrow ? half_m + 1.6 : 13.0;
        EXPECT_LT(std::max(left_m, right_m), most_m) << name << ", seed " << seed;
      }
    }
  }
}

/// The hits of rays straight down on points (x, y) of the car's frame.
std::vector<Hit> hits_below(const World& world, const RayCaster& caster,
                            const std::vector<Eigen::Vector2d>& points) {
  const RigidTransform& T = world.car.T_world_body;
  std::vector<Ray> rays;
  for (const Eigen::Vector2d& point : points) {
    rays.push_back({T * Vector3d(point.x(), point.y(), 100.0), -Vector3d::UnitZ(), 0.0});
  }
  return caster.cast(rays, 0.0, 200.0);
}

bool is_road(const Hit& hit) {
  if (!hit.is_there()) return false;
  return hit.material == Material::asphalt || hit.material == Material::marking;
}

/// The carriageways of a scene alone.
std::shared_ptr<const World> only_road(const World& world) {
  auto road = std::make_shared<World>();
  road->car = world.car;
  road->fixed.vertices = world.fixed.vertices;
  for (std::size_t i = 0; i < world.fixed.triangles.size(); ++i) {
    const auto& [a, b, c] = world.fixed.triangles[i];
    const Material material = world.fixed.materials[i];
    if (material != Material::asphalt && material != Material::marking) continue;
    road->fixed.add_triangle(a, b, c, material);
  }
  return road;
}

/// The length of asphalt across the car's direction, through the point `ahead_m` ahead of the car.
double asphalt_across_m(const World& road, const RayCaster& caster, double ahead_m) {
  constexpr double kStep_m = 0.5;
  std::vector<Eigen::Vector2d> points;
  for (double left_m = -60.0; left_m <= 60.0; left_m += kStep_m)
    points.emplace_back(ahead_m, left_m);
  double length_m = 0.0;
  for (const Hit& hit : hits_below(road, caster, points)) length_m += is_road(hit) ? kStep_m : 0.0;
  return length_m;
}

TEST(Crossing, HasArmsThatMeet) {
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    double longest_m = 0.0;
    const auto road = only_road(scene(SceneKind::crossing, seed));
    const RayCaster caster(road, {});
    for (double ahead_m = -14.0; ahead_m <= 30.0; ahead_m += 1.0) {
      longest_m = std::max(longest_m, asphalt_across_m(*road, caster, ahead_m));
    }
    // The arms run on straight from one side to the other, but a car that turns is at an angle.
    EXPECT_GT(longest_m, 30.0) << "seed " << seed;
    const auto street = only_road(scene(SceneKind::urban, seed));
    EXPECT_LT(asphalt_across_m(*street, RayCaster(street, {}), 0.0), 25.0) << "seed " << seed;
  }
}

/// The share of level rays to both sides of the car, `above_m` over the road, that meet a material
/// of `materials` within `most_m`.
double seen_share(const World& world, const RayCaster& caster, double above_m, double most_m,
                  const std::vector<Material>& materials) {
  const RigidTransform& T = world.car.T_world_body;
  std::vector<Ray> rays;
  for (double ahead_m = -50.0; ahead_m <= 50.0; ahead_m += 0.25) {
    for (const double side : {-1.0, 1.0}) {
      rays.push_back({T * Vector3d(ahead_m, 0.0, above_m), T.rotation * Vector3d(0.0, side, 0.0)});
    }
  }
  double seen = 0.0;
  for (const Hit& hit : caster.cast(rays, 0.0, most_m)) {
    const bool is_one_of =
        std::find(materials.begin(), materials.end(), hit.material) != materials.end();
    seen += hit.is_there() && is_one_of ? 1.0 : 0.0;
  }
  return seen / static_cast<double>(rays.size());
}

/// What is seen beside the car, as means of seen_share over the seeds.
struct Views {
  double walls = 0.0;     ///< Of buildings, 6 m above the road.
  double barriers = 0.0;  ///< Of metal and concrete, at the height of guard rails.
};

Views mean_views(SceneKind kind) {
  Views views;
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    const auto world = std::make_shared<const World>(scene(kind, seed));
    const RayCaster caster(world, {});
    views.walls +=
        seen_share(*world, caster, 6.0, 30.0,
                   {Material::brick, Material::plaster, Material::concrete, Material::glass}) /
        kSceneSeeds;
    views.barriers +=
        seen_share(*world, caster, 0.6, 25.0, {Material::metal, Material::concrete}) / kSceneSeeds;
  }
  return views;
}

TEST(OrdinaryKinds, HaveTheFeaturesOfTheirKind) {
  const Views urban = mean_views(SceneKind::urban);
  const Views suburban = mean_views(SceneKind::suburban);
  const Views highway = mean_views(SceneKind::highway);
  EXPECT_GT(urban.walls, 0.2);
  EXPECT_LT(suburban.walls, 0.75 * urban.walls);
  EXPECT_LT(highway.walls, 0.25 * urban.walls);
  EXPECT_GT(highway.barriers, 0.4);
  EXPECT_LT(urban.barriers, 0.3);
  for (std::uint64_t seed = 0; seed < kSceneSeeds; ++seed) {
    const auto car_park = only_road(scene(SceneKind::car_park, seed));
    EXPECT_GT(asphalt_across_m(*car_park, RayCaster(car_park, {}), 0.0), 30.0) << "seed " << seed;
  }
}

TEST(SceneKinds, DifferInTheirScenesForTheSameKey) {
  std::vector<World> worlds;
  for (const SceneKindRow& kind : kSceneKinds) worlds.push_back(kind.make(kSceneCar, StreamKey(7)));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(test::are_same(worlds[i].fixed, worlds[j].fixed))
          << kSceneKinds[i].name << " and " << kSceneKinds[j].name;
    }
  }
}

TEST(Mix, OfThePaperHasTheSharesOfItsTable) {
  // 101 of the paper's 1899 frames fail; they are of the four hard kinds.
  Mix mix = paper_mix();
  double total = 0.0;
  for (const double weight : mix.weights) total += weight;
  EXPECT_NEAR(total, 100.0, 1e-9);
  const double hard = mix[SceneKind::empty] + mix[SceneKind::narrow] + mix[SceneKind::blocked] +
                      mix[SceneKind::corridor];
  EXPECT_NEAR(hard / total, 101.0 / 1899.0, 0.001);
}

}  // namespace
}  // namespace croon::simulation
