#include "test/framework/simulation/objects/mesh_checks.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon::simulation::test {

using Eigen::Vector3d;
using Eigen::Vector3f;

Eigen::AlignedBox3d bounds_of(const Mesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3f& vertex : mesh.vertices) bounds.extend(vertex.cast<double>().eval());
  return bounds;
}

void expect_sound(const Mesh& mesh, std::size_t most) {
  ASSERT_FALSE(mesh.triangles.empty());
  EXPECT_LE(mesh.triangles.size(), most);
  ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
  for (const Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
  for (const auto& [a, b, c] : mesh.triangles) {
    ASSERT_LT(std::max({a, b, c}), mesh.vertices.size());
    const Vector3d corner = mesh.vertices[a].cast<double>();
    const Vector3d ab = mesh.vertices[b].cast<double>() - corner;
    const Vector3d ac = mesh.vertices[c].cast<double>() - corner;
    EXPECT_GT(ab.cross(ac).norm(), 1e-6) << "at " << corner.transpose();
  }
}

void expect_drawn_from_its_rng(const std::function<Mesh(Rng&)>& make) {
  const auto made = [&](std::uint64_t seed) {
    Rng rng = croon::test::test_rng(seed);
    return make(rng);
  };
  const auto are_same = [](const Mesh& a, const Mesh& b) {
    return a.vertices == b.vertices && a.triangles == b.triangles && a.materials == b.materials;
  };
  for (std::uint64_t seed = 1; seed < 10; ++seed) {
    EXPECT_TRUE(are_same(made(seed), made(seed)));
    EXPECT_FALSE(are_same(made(seed), made(seed + 1)));
  }
}

std::unique_ptr<RayCaster> caster_of(const Mesh& mesh) {
  auto world = std::make_shared<World>();
  world->fixed = mesh;
  return std::make_unique<RayCaster>(world, TimeWindow{});
}

}  // namespace croon::simulation::test
