#include "test/support/mesh_checks.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::test {

using Eigen::Vector3d;
using simulation::Mesh;

void expect_whole(const Mesh& mesh) {
  ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  for (const auto& [a, b, c] : mesh.triangles) {
    ASSERT_LT(std::max({a, b, c}), mesh.vertices.size());
  }
}

void expect_sound(const Mesh& mesh, std::size_t most, std::size_t flat) {
  ASSERT_FALSE(mesh.triangles.empty());
  EXPECT_LE(mesh.triangles.size(), most);
  expect_whole(mesh);
  std::size_t without_area = 0;
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    without_area += (b - a).cross(c - a).norm() <= 1e-6;
  }
  EXPECT_EQ(without_area, flat);
}

bool are_same(const Mesh& a, const Mesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && a.materials == b.materials;
}

void expect_drawn_from_its_rng(const std::function<Mesh(Rng&)>& make) {
  const auto made = [&](std::uint64_t seed) {
    Rng rng = test_rng(seed);
    return make(rng);
  };
  for (std::uint64_t seed = 1; seed < 10; ++seed) {
    EXPECT_TRUE(are_same(made(seed), made(seed)));
    EXPECT_FALSE(are_same(made(seed), made(seed + 1)));
  }
}

void expect_closed_around(const Mesh& mesh, const Vector3d& inside, Rng& rng) {
  constexpr double kFrom_m = 40.0;
  std::vector<simulation::Ray> rays;
  for (int i = 0; i < 400; ++i) {
    const Vector3d direction = random_pose(rng, 1.0).rotation.col(0);
    rays.push_back({inside - kFrom_m * direction, direction, 0.0});
  }
  for (const simulation::Hit& hit : caster_of(mesh)->cast(rays, 0.0, kFrom_m)) {
    ASSERT_TRUE(hit.is_there()) << "a ray reached " << inside.transpose();
  }
}

}  // namespace croon::test
