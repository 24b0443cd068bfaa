// What stands beside the road and drives on it: meshes that hold together, of the documented sizes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "framework/simulation/objects/person.hpp"
#include "framework/simulation/objects/plants.hpp"
#include "framework/simulation/objects/street_furniture.hpp"
#include "framework/simulation/objects/vehicles.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3f;

constexpr std::uint64_t kSeeds = 150;

/// An object and what its documentation says of it.
struct Object {
  std::string name;
  std::function<Mesh(Rng&)> make;
  std::size_t most_triangles = 0;
  float least_height_m = 0.0F;
  float most_height_m = 0.0F;
  bool has_poles = false;  ///< Ellipsoids, whose triangles at the poles have no area.
};

std::ostream& operator<<(std::ostream& out, const Object& object) { return out << object.name; }

std::function<Mesh(Rng&)> mesh_of(VehicleType type) {
  return [type](Rng& rng) { return make_vehicle(type, rng).mesh; };
}

Mesh make_some_hedge(Rng& rng) { return make_hedge(6.5, 1.5, 0.8, rng); }
Mesh make_some_tufts(Rng& rng) { return make_tufts(5.0, 1.0, rng); }
Mesh make_some_gantry(Rng& rng) { return make_gantry(11.0, rng); }

std::vector<Object> objects() {
  return {{"car", mesh_of(VehicleType::car), 1200, 1.35F, 1.9F},
          {"van", mesh_of(VehicleType::van), 1200, 1.9F, 2.7F},
          {"truck", mesh_of(VehicleType::truck), 1200, 2.6F, 4.0F},
          {"bus", mesh_of(VehicleType::bus), 1200, 2.9F, 3.3F},
          {"person", make_person, 400, 1.2F, 1.95F, true},
          {"tree", make_tree, 900, 4.0F, 12.0F},
          {"bush", make_bush, 200, 0.5F, 1.8F, true},
          {"hedge", make_some_hedge, 260, 1.35F, 1.55F},
          {"tufts", make_some_tufts, 200, 0.3F, 0.7F},
          {"lamp", make_lamp, 250, 4.9F, 9.0F},
          {"traffic_light", make_traffic_light, 250, 2.8F, 3.8F},
          {"sign", make_sign, 250, 2.0F, 5.0F},
          {"bollard", make_bollard, 250, 0.7F, 1.1F},
          {"bin", make_bin, 250, 0.85F, 1.3F},
          {"bench", make_bench, 250, 0.4F, 1.0F},
          {"bus_stop", make_bus_stop, 250, 2.4F, 2.8F},
          {"gantry", make_some_gantry, 500, 6.4F, 8.0F}};
}

Mesh make(const Object& object, std::uint64_t seed) {
  Rng rng = test::test_rng(seed);
  return object.make(rng);
}

Eigen::AlignedBox3f bounds_of(const Mesh& mesh) {
  Eigen::AlignedBox3f bounds;
  for (const Vector3f& vertex : mesh.vertices) bounds.extend(vertex);
  return bounds;
}

bool are_same(const Mesh& a, const Mesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && a.materials == b.materials;
}

double area_of(const Mesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t i) {
    return mesh.vertices[mesh.triangles[triangle][i]].cast<double>().eval();
  };
  return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
}

class ObjectTest : public testing::TestWithParam<Object> {};

TEST_P(ObjectTest, IsDrawnFromItsGeneratorAlone) {
  for (std::uint64_t seed = 1; seed < 10; ++seed) {
    EXPECT_TRUE(are_same(make(GetParam(), seed), make(GetParam(), seed)));
    EXPECT_FALSE(are_same(make(GetParam(), seed), make(GetParam(), seed + 1)));
  }
}

TEST_P(ObjectTest, HasOneMaterialPerTriangleAndCornersThatExist) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Mesh mesh = make(GetParam(), seed);
    ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
    ASSERT_LE(mesh.triangles.size(), GetParam().most_triangles) << "seed " << seed;
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
    }
    for (const Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  }
}

TEST_P(ObjectTest, StandsOnTheGroundAndIsAsHighAsDocumented) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Eigen::AlignedBox3f bounds = bounds_of(make(GetParam(), seed));
    ASSERT_NEAR(bounds.min().z(), 0.0F, 0.05F) << "seed " << seed;
    ASSERT_GE(bounds.max().z(), GetParam().least_height_m) << "seed " << seed;
    ASSERT_LE(bounds.max().z(), GetParam().most_height_m + 1e-4F) << "seed " << seed;
  }
}

TEST_P(ObjectTest, HasTrianglesWithAnAreaButAtPoles) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Mesh mesh = make(GetParam(), seed);
    std::size_t flat = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) flat += area_of(mesh, i) < 1e-9;
    // An ellipsoid of 8 meridians has as many such triangles at each of its poles.
    ASSERT_EQ(flat, GetParam().has_poles ? 16 : 0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Simulation, ObjectTest, testing::ValuesIn(objects()),
                         [](const auto& object) { return object.param.name; });

}  // namespace
}  // namespace croon::simulation
