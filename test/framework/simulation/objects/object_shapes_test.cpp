// Properties of single types of objects: sizes, directions and closed bodies.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/simulation/objects/objects.hpp"
#include "test/support/mesh_checks.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::bounds_of;
using test::expect_closed_around;

constexpr std::uint64_t kShapeSeeds = 60;
constexpr double kShapeEpsilon_m = 1e-4;

struct VehicleRange {
  VehicleType type;
  double least_length_m;
  double most_length_m;
  double most_width_m;  ///< With mirrors.
};

const std::vector<VehicleRange> kVehicles = {{VehicleType::car, 3.6, 5.05, 2.2},
                                             {VehicleType::van, 5.0, 6.55, 2.3},
                                             {VehicleType::truck, 7.0, 16.05, 3.0},
                                             {VehicleType::bus, 11.0, 18.05, 3.0}};

TEST(Vehicle, IsInsideItsSizeAndTheSizeInItsRange) {
  for (const VehicleRange& range : kVehicles) {
    for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
      Rng rng = test::test_rng(seed);
      const Vehicle vehicle = make_vehicle(range.type, rng);
      const Vector3d size_m = vehicle.size_m;
      const Eigen::AlignedBox3d bounds = bounds_of(vehicle.mesh);
      EXPECT_LE(bounds.max().x(), 0.5 * size_m.x() + kShapeEpsilon_m);
      EXPECT_GE(bounds.min().x(), -0.5 * size_m.x() - kShapeEpsilon_m);
      EXPECT_LE(bounds.max().y(), 0.5 * size_m.y() + kShapeEpsilon_m);
      EXPECT_GE(bounds.min().y(), -0.5 * size_m.y() - kShapeEpsilon_m);
      EXPECT_LE(bounds.max().z(), size_m.z() + kShapeEpsilon_m);
      EXPECT_GE(size_m.x(), range.least_length_m);
      EXPECT_LE(size_m.x(), range.most_length_m);
      EXPECT_LE(size_m.y(), range.most_width_m);
      EXPECT_NEAR(bounds.center().x(), 0.0, 0.05);
    }
  }
}

TEST(Vehicle, StopsRaysFromAllAround) {
  for (const VehicleRange& range : kVehicles) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Rng rng = test::test_rng(seed);
      const Vehicle vehicle = make_vehicle(range.type, rng);
      const double length_m = vehicle.size_m.x();
      const double height_m = vehicle.size_m.z();
      // A truck has a gap behind its cab, and not every load is as high as it; its cab is closed.
      const bool is_truck = range.type == VehicleType::truck;
      const std::vector<Vector3d> insides =
          is_truck ? std::vector<Vector3d>{{0.5 * length_m - 1.0, 0.2, 0.55 * height_m}}
                   : std::vector<Vector3d>{{0.0, 0.2, 0.4 * height_m},
                                           {-0.15 * length_m, -0.3, 0.75 * height_m}};
      for (const Vector3d& inside : insides) expect_closed_around(vehicle.mesh, inside, rng);
    }
  }
}

TEST(Vehicle, IsNarrowerAtTheRoofThanAtTheBelt) {
  for (const VehicleType type : {VehicleType::car, VehicleType::van}) {
    for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
      Rng rng = test::test_rng(seed);
      const Vehicle vehicle = make_vehicle(type, rng);
      double roof_m = 0.0;
      for (const Vector3f& vertex : vehicle.mesh.vertices) {
        if (vertex.z() > 0.93 * vehicle.size_m.z()) {
          roof_m = std::max(roof_m, std::abs(static_cast<double>(vertex.y())));
        }
      }
      EXPECT_LT(roof_m, 0.45 * vehicle.size_m.y());
      EXPECT_GT(roof_m, 0.2 * vehicle.size_m.y());
    }
  }
}

TEST(Person, StopsRaysAndStandsOverTheOrigin) {
  for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
    Rng rng = test::test_rng(seed);
    const Mesh mesh = make_person(rng);
    const Eigen::AlignedBox3d bounds = bounds_of(mesh);
    EXPECT_TRUE(bounds.contains(Vector3d(0.0, 0.0, 0.5)));
    EXPECT_LT(bounds.sizes().x(), 0.8 * bounds.max().z());
    EXPECT_LT(bounds.sizes().y(), 0.5 * bounds.max().z());
    expect_closed_around(mesh, {0.0, 0.0, 0.7 * bounds.max().z()}, rng);
  }
}

TEST(Hedge, FillsItsLengthAndWidth) {
  for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
    Rng rng = test::test_rng(seed);
    const double length_m = rng.uniform(2.0, 20.0);
    const double height_m = rng.uniform(0.8, 2.2);
    const double width_m = rng.uniform(0.5, 1.2);
    const Mesh mesh = make_hedge(length_m, height_m, width_m, rng);
    const Eigen::AlignedBox3d bounds = bounds_of(mesh);
    EXPECT_LE(static_cast<double>(mesh.triangles.size()), 40.0 * length_m);
    EXPECT_NEAR(bounds.min().x(), 0.0, 0.1);
    EXPECT_NEAR(bounds.max().x(), length_m, 0.1);
    EXPECT_NEAR(bounds.sizes().y(), width_m, 0.15);
    EXPECT_NEAR(bounds.max().z(), height_m, 0.1);
    const Vector3d inside(0.5 * length_m, 0.0, 0.5 * height_m);
    expect_closed_around(mesh, inside, rng);
  }
}

TEST(Tufts, StayAboutTheirStrip) {
  for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
    Rng rng = test::test_rng(seed);
    const double length_m = rng.uniform(1.0, 20.0);
    const double width_m = rng.uniform(0.3, 2.0);
    const Mesh mesh = make_tufts(length_m, width_m, rng);
    const Eigen::AlignedBox3d bounds = bounds_of(mesh);
    EXPECT_LE(static_cast<double>(mesh.triangles.size()), 40.0 * length_m + 9.0);
    EXPECT_GE(bounds.min().x(), -0.5);
    EXPECT_LE(bounds.max().x(), length_m + 0.5);
    EXPECT_LE(bounds.sizes().y(), width_m + 1.0);
  }
}

TEST(Lamp, ReachesOutAlongX) {
  for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
    Rng rng = test::test_rng(seed);
    const Eigen::AlignedBox3d bounds = bounds_of(make_lamp(rng));
    EXPECT_GT(bounds.max().x(), 1.0);
    EXPECT_GT(bounds.min().x(), -0.25);
  }
}

TEST(Gantry, LeavesTheRoadClear) {
  for (std::uint64_t seed = 1; seed <= kShapeSeeds; ++seed) {
    Rng rng = test::test_rng(seed);
    const double width_m = rng.uniform(6.0, 16.0);
    const Mesh mesh = make_gantry(width_m, rng);
    for (const Vector3f& vertex : mesh.vertices) {
      if (std::abs(vertex.y()) < 0.5 * width_m) {
        EXPECT_GE(vertex.z(), 5.2 - kShapeEpsilon_m);
      }
    }
    EXPECT_GT(bounds_of(mesh).max().y(), 0.5 * width_m);
    EXPECT_LT(bounds_of(mesh).min().y(), -0.5 * width_m);
  }
}

}  // namespace
}  // namespace croon::simulation
