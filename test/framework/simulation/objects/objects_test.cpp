// All objects: sound meshes of the documented sizes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "framework/simulation/objects/objects.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

constexpr std::uint64_t kObjectSeeds = 150;

/// An object and its documented size.
struct Object {
  std::string name;
  std::function<Mesh(Rng&)> make;
  std::size_t most_triangles = 0;
  double least_height_m = 0.0;
  double most_height_m = 0.0;
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
  return {{"car", mesh_of(VehicleType::car), 1200, 1.35, 1.9},
          {"van", mesh_of(VehicleType::van), 1200, 1.9, 2.7},
          {"truck", mesh_of(VehicleType::truck), 1200, 2.6, 4.0},
          {"bus", mesh_of(VehicleType::bus), 1200, 2.9, 3.3},
          {"person", make_person, 400, 1.2, 1.95, true},
          {"tree", make_tree, 900, 4.0, 12.0},
          {"bush", make_bush, 200, 0.5, 1.8, true},
          {"hedge", make_some_hedge, 260, 1.35, 1.55},
          {"tufts", make_some_tufts, 200, 0.3, 0.7},
          {"lamp", make_lamp, 250, 4.9, 9.0},
          {"traffic_light", make_traffic_light, 250, 2.8, 3.8},
          {"sign", make_sign, 250, 2.0, 5.0},
          {"bollard", make_bollard, 250, 0.7, 1.1},
          {"bin", make_bin, 250, 0.85, 1.3},
          {"bench", make_bench, 250, 0.4, 1.0},
          {"bus_stop", make_bus_stop, 250, 2.4, 2.8},
          {"gantry", make_some_gantry, 500, 6.4, 8.0}};
}

Mesh make(const Object& object, std::uint64_t seed) {
  Rng rng = test::test_rng(seed);
  return object.make(rng);
}

class ObjectTest : public testing::TestWithParam<Object> {};

TEST_P(ObjectTest, IsDrawnFromItsGeneratorAlone) {
  test::expect_drawn_from_its_rng(GetParam().make);
}

TEST_P(ObjectTest, IsSoundAndHasAreasButAtPoles) {
  for (std::uint64_t seed = 1; seed <= kObjectSeeds; ++seed) {
    SCOPED_TRACE(seed);
    // An ellipsoid of 8 meridians has as many triangles without an area at each of its poles.
    test::expect_sound(make(GetParam(), seed), GetParam().most_triangles,
                       GetParam().has_poles ? 16 : 0);
  }
}

TEST_P(ObjectTest, StandsOnTheGroundAndIsAsHighAsDocumented) {
  for (std::uint64_t seed = 1; seed <= kObjectSeeds; ++seed) {
    const Eigen::AlignedBox3d bounds = test::bounds_of(make(GetParam(), seed));
    ASSERT_NEAR(bounds.min().z(), 0.0, 0.05) << "seed " << seed;
    ASSERT_GE(bounds.max().z(), GetParam().least_height_m) << "seed " << seed;
    ASSERT_LE(bounds.max().z(), GetParam().most_height_m + 1e-4) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Simulation, ObjectTest, testing::ValuesIn(objects()),
                         [](const auto& object) { return object.param.name; });

}  // namespace
}  // namespace croon::simulation
