// Every kind of scene, over many seeds: whole meshes, room for the car, and what its name says.
#include "framework/simulation/scenes/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/simulation/ray_caster.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr CarSpace kCar = {4.7, 1.9};
constexpr std::uint64_t kSeeds = 12;

World scene(SceneKind kind, std::uint64_t seed) {
  return make_scene(kind, kCar, StreamKey(seed).with("scene test"));
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.materials, b.materials);
}

void expect_whole(const Mesh& mesh) {
  ASSERT_EQ(mesh.triangles.size(), mesh.materials.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
  }
}

/// The vertices of all but the car, in the car's frame.
PointCloud seen_from_car(const World& world) {
  const RigidTransform T_car_world = world.car.T_world_body.inverse();
  PointCloud points = transformed(world.fixed.vertices, T_car_world);
  for (const Body& body : world.bodies) {
    const PointCloud own = transformed(body.mesh.vertices, T_car_world * body.T_world_body);
    points.insert(points.end(), own.begin(), own.end());
  }
  return points;
}

/// The range from a place in the car's frame along a direction in it.
double range_m(const RayCaster& caster, const World& world, const Vector3d& from,
               const Vector3d& along) {
  const RigidTransform& T = world.car.T_world_body;
  return caster.cast({{T * from, T.rotation * along, 0.0}}, 0.0, 100.0).front().range_m;
}

/// The nearest of what stands beside the car, at any height up to 3 m: a lorry has gaps, and its
/// tank is nearest at its widest.
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
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const World world = scene(kind(), seed);
    const World again = scene(kind(), seed);
    expect_same(world.fixed, again.fixed);
    expect_whole(world.fixed);
    ASSERT_EQ(world.bodies.size(), again.bodies.size());
    std::size_t triangles = world.fixed.triangles.size();
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      expect_same(world.bodies[i].mesh, again.bodies[i].mesh);
      expect_whole(world.bodies[i].mesh);
      triangles += world.bodies[i].mesh.triangles.size();
    }
    EXPECT_LT(triangles, 220000U);
    EXPECT_TRUE(world.car.mesh.triangles.empty());
    EXPECT_NE(world.fixed.vertices, scene(kind(), seed + 100).fixed.vertices);
  }
}

TEST_P(EveryKind, LeavesTheCarItsSpace) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const Eigen::Vector3f& point : seen_from_car(scene(kind(), seed))) {
      const bool is_in_car = std::abs(point.x()) < 0.5 * kCar.length_m &&
                             std::abs(point.y()) < 0.5 * kCar.width_m && point.z() > 0.3F &&
                             point.z() < 2.5F;
      EXPECT_FALSE(is_in_car) << "seed " << seed << ": " << point.transpose();
    }
  }
}

TEST_P(EveryKind, HasGroundUnderTheCar) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto world = std::make_shared<const World>(scene(kind(), seed));
    const RayCaster caster(world, {});
    for (const double x_m : {-1.3, 0.0, 1.3}) {
      EXPECT_NEAR(range_m(caster, *world, {x_m, 0.0, 1.0}, -Vector3d::UnitZ()), 1.0, 0.1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, testing::Range(std::size_t{0}, kSceneKinds),
                         [](const auto& kind) { return kSceneKindNames[kind.param]; });

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
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
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
      EXPECT_EQ(on_road, 0) << kSceneKindNames[static_cast<std::size_t>(kind)] << ", seed " << seed;
    }
  }
}

TEST(HardKinds, AreWhatTheyAreCalled) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const Eigen::Vector3f& point : seen_from_car(scene(SceneKind::empty, seed))) {
      if (point.head<2>().norm() > 20.0F) continue;
      EXPECT_LT(point.z(), 1.5F) << "empty, seed " << seed;
    }
    for (const SceneKind kind : {SceneKind::narrow, SceneKind::corridor, SceneKind::blocked}) {
      const auto world = std::make_shared<const World>(scene(kind, seed));
      const RayCaster caster(world, {});
      const double left_m = beside_m(caster, *world, Vector3d::UnitY());
      const double right_m = beside_m(caster, *world, -Vector3d::UnitY());
      const double half_m = 0.5 * kCar.width_m;
      const char* const name = kSceneKindNames[static_cast<std::size_t>(kind)];
      if (kind == SceneKind::blocked) {
        // At most 0.9 m to its mirrors, which stand out by up to 0.3 m.
        EXPECT_LT(std::min(left_m, right_m), half_m + 1.2) << name << ", seed " << seed;
      } else {
        const double most_m = kind == SceneKind::narrow ? half_m + 1.6 : 13.0;
        EXPECT_LT(std::max(left_m, right_m), most_m) << name << ", seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace croon::simulation
