// The points of a simulated scene lie on its surfaces, and do not depend on threads or order.
#include "framework/simulation/simulated_scene.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using test::recipe_of;
using test::Triangle;
using Triangles = std::vector<Triangle>;

double distance_to_segment_m(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

double distance_m(const Vector3d& p, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d normal = (b - a).cross(c - a);
  double least = std::min({distance_to_segment_m(p, a, b), distance_to_segment_m(p, b, c),
                           distance_to_segment_m(p, c, a)});
  const bool is_over = normal.cross(b - a).dot(p - a) >= 0.0 &&
                       normal.cross(c - b).dot(p - b) >= 0.0 &&
                       normal.cross(a - c).dot(p - c) >= 0.0;
  if (is_over && normal.squaredNorm() > 0.0) {
    least = std::min(least, std::abs(normal.normalized().dot(p - a)));
  }
  return least;
}

double distance_m(const Vector3d& p, const Triangles& triangles) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) least = std::min(least, distance_m(p, triangle));
  return least;
}

RigidTransform T_world_sensor(const SimulatedScene& scene, const Recipe& recipe,
                              const Mounting& mounting) {
  return scene.world().car.T_world_body * recipe.rig.T_car_reference() *
         mounting.T_reference_sensor();
}

/// Every `n`-th point of a cloud.
Points every(const Points& cloud, std::size_t n) {
  Points some;
  for (std::size_t i = 0; i < cloud.size(); i += n) some.push_back(cloud[i]);
  return some;
}

TEST(SimulatedScene, EveryPointLiesOnASurface) {
  for (const SceneKind kind : {SceneKind::urban, SceneKind::crossing, SceneKind::narrow}) {
    const auto recipe = recipe_of(kind);
    const SimulatedScene scene(recipe, 3);
    const Triangles triangles = test::triangles_of(scene.world());
    for (const auto& [name, mounting] : recipe->rig.sensors) {
      const RigidTransform T = T_world_sensor(scene, *recipe, mounting);
      const Points cloud = scene.scan_of(name).points;
      ASSERT_GT(cloud.size(), 1000U);
      for (const Eigen::Vector3f& point : every(cloud, cloud.size() / 15)) {
        EXPECT_LT(distance_m(T * point.cast<double>(), triangles), 1e-4) << name;
      }
    }
  }
}

/// The indices of the triangles over each square metre of the xy plane.
std::map<std::pair<int, int>, std::vector<std::size_t>> cells_of(const Triangles& ground) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    Vector3d low = ground[i][0];
    Vector3d high = low;
    for (const Vector3d& corner : ground[i]) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    for (int x = static_cast<int>(std::floor(low.x())); x <= high.x(); ++x) {
      for (int y = static_cast<int>(std::floor(low.y())); y <= high.y(); ++y) {
        cells[{x, y}].push_back(i);
      }
    }
  }
  return cells;
}

TEST(SimulatedScene, CloudsAgreeOnTheGroundToAMillimetre) {
  const auto recipe = recipe_of(SceneKind::empty);
  for (const std::uint64_t index : {0U, 5U}) {
    const SimulatedScene scene(recipe, index);
    const Triangles ground = test::triangles_of(scene.world().fixed);
    const auto cells = cells_of(ground);
    for (const auto& [name, mounting] : recipe->rig.sensors) {
      const RigidTransform T = T_world_sensor(scene, *recipe, mounting);
      const RigidTransform T_car_world = scene.world().car.T_world_body.inverse();
      int counted = 0;
      for (const Eigen::Vector3f& point : every(scene.scan_of(name).points, 50)) {
        const Vector3d in_world = T * point.cast<double>();
        const Vector3d on_car = T_car_world * in_world;
        const bool is_car = std::abs(on_car.x()) < 2.6 && std::abs(on_car.y()) < 1.2;
        if (is_car || on_car.head<2>().norm() > 20.0) continue;
        const auto cell = cells.find({static_cast<int>(std::floor(in_world.x())),
                                      static_cast<int>(std::floor(in_world.y()))});
        ASSERT_NE(cell, cells.end());
        double least = 1.0;
        for (const std::size_t i : cell->second) {
          least = std::min(least, distance_m(in_world, ground[i]));
        }
        EXPECT_LT(least, 1e-3) << name;
        ++counted;
      }
      EXPECT_GT(counted, 50) << name;
    }
  }
}

/// The bytes of all clouds of a scene.
std::string bytes_of(const SimulatedScene& scene, const Recipe& recipe) {
  std::string bytes;
  for (const auto& [name, mounting] : recipe.rig.sensors) {
    const PointCloud cloud = scene.scan_of(name);
    const auto* first = reinterpret_cast<const char*>(cloud.points.data());
    bytes.append(first, cloud.points.size() * sizeof(Eigen::Vector3f));
    for (const Channel& channel : cloud.channels) bytes += channel.bytes;
  }
  return bytes;
}

/// The recipe with the noise of a driving car at `speed_mps`.
Recipe driving_at(double speed_mps) {
  Recipe recipe = *recipe_of(SceneKind::crossing, real_noise());
  recipe.speed_mps = speed_mps;
  return recipe;
}

TEST(SimulatedScene, HasTheSpeedThatIsAsked) {
  for (std::uint64_t index = 0; index < 3; ++index) {
    const SimulatedScene own(std::make_shared<const Recipe>(driving_at(-1.0)), index);
    const Motion& motion = own.world().car.motion;
    for (const double speed_mps : {0.0, 2.0, 30.0}) {
      const SimulatedScene scene(std::make_shared<const Recipe>(driving_at(speed_mps)), index);
      const Motion& asked = scene.world().car.motion;
      EXPECT_EQ(asked.speed_mps, speed_mps);
      EXPECT_LT(std::abs(asked.yaw_rate_radps * speed_mps), 4.0 + 1e-9);
      // The arc is the same, or wider at a high speed.
      EXPECT_LE(std::abs(asked.yaw_rate_radps * motion.speed_mps),
                std::abs(motion.yaw_rate_radps * speed_mps) + 1e-9);
      EXPECT_GE(asked.yaw_rate_radps * motion.yaw_rate_radps, 0.0);
      EXPECT_EQ(test::triangles_of(scene.world().fixed), test::triangles_of(own.world().fixed));
    }
  }
}

TEST(SimulatedScene, ClocksGoWrongByTheOffsetThatIsAsked) {
  Recipe recipe = driving_at(10.0);
  const SimulatedScene right(std::make_shared<const Recipe>(recipe), 0);
  recipe.noise.clock_offset_s = 0.02;
  const SimulatedScene wrong(std::make_shared<const Recipe>(recipe), 0);
  for (const char* const sensor : {"top", "left"}) {
    const PointCloud by_right = right.scan_of(sensor), by_wrong = wrong.scan_of(sensor);
    EXPECT_EQ(by_right.points, by_wrong.points);
    const double offset_s = times_s(by_wrong).at(7) - times_s(by_right).at(7);
    EXPECT_NEAR(offset_s, std::string(sensor) == "top" ? 0.0 : 0.02, 1e-12);
  }
}

TEST(SimulatedScene, IsTheSameAloneInAnyOrderAndOnAnyNumberOfThreads) {
  auto recipe = std::make_shared<Recipe>();
  recipe->noise = real_noise();
  constexpr std::uint64_t kScenes = 3;
  std::vector<std::string> in_order, in_parallel(kScenes);
  for (std::uint64_t i = kScenes; i-- > 0;) {
    in_order.insert(in_order.begin(), bytes_of(SimulatedScene(recipe, i), *recipe));
  }
  tbb::task_arena(3).execute([&] {
    tbb::parallel_for(std::uint64_t{0}, kScenes, [&](std::uint64_t i) {
      in_parallel[i] = bytes_of(SimulatedScene(recipe, i), *recipe);
    });
  });
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    EXPECT_EQ(in_order[i], in_parallel[i]) << "scene " << i;
    for (std::uint64_t j = 0; j < i; ++j) EXPECT_NE(in_order[i], in_order[j]);
  }
  Recipe other = *recipe;
  other.seed = 2;
  const auto shared = std::make_shared<const Recipe>(other);
  EXPECT_NE(bytes_of(SimulatedScene(shared, 0), other), in_order[0]);
}

TEST(SimulatedScene, KindsFollowTheMix) {
  Recipe recipe;
  recipe.mix = {};
  recipe.mix[SceneKind::urban] = 3.0;
  recipe.mix[SceneKind::narrow] = 1.0;
  std::map<SceneKind, int> counts;
  for (std::uint64_t i = 0; i < 4000; ++i) ++counts[scene_kind(recipe, i)];
  EXPECT_EQ(counts.size(), 2U);
  EXPECT_NEAR(counts[SceneKind::urban], 3000, 110);
}

TEST(SimulatedScene, TheFiveSensorsFireTheRaysOfTheSamples) {
  std::size_t rays = 0;
  for (const auto& [name, mounting] : Recipe{}.rig.sensors) {
    rays += azimuths_deg(mounting.model).size() * mounting.model.elevations_deg.size();
  }
  EXPECT_EQ(rays, 64U * (1800U + 4U * 600U));
}

TEST(SimulatedScene, SensorsSeeTheirOwnCar) {
  const auto recipe = recipe_of(SceneKind::empty);
  const SimulatedScene scene(recipe, 1);
  for (const char* name : {"front", "back", "left", "right"}) {
    const Points cloud = scene.scan_of(name).points;
    EXPECT_TRUE(std::any_of(cloud.begin(), cloud.end(), [](const Eigen::Vector3f& p) {
      return p.norm() < 0.8F;
    })) << name;
  }
}

}  // namespace
}  // namespace croon::simulation
