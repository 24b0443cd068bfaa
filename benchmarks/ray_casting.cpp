// What does a ray cost, with Embree's packets and with CGAL's AABB tree?

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "benchmarks/support/run.hpp"
#include "framework/base/angles.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::benchmarks {
namespace {

using simulation::Hit;
using simulation::Ray;
using simulation::SimulatedScene;

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double kMax_m = 200.0;

Kernel::Point_3 point_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Triangles triangles_of(const simulation::World& world) {
  Triangles triangles;
  for (const auto& [a, b, c] : test::triangles_of(world)) {
    const Kernel::Triangle_3 triangle(point_of(a), point_of(b), point_of(c));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  return triangles;
}

/// One scan of 64 rings from above the car, without noise.
std::vector<Ray> rays_of(const SimulatedScene& scene) {
  const RigidTransform T = scene.world().car.T_world_body;
  std::vector<Ray> rays;
  for (int azimuth = 0; azimuth < 360; ++azimuth) {
    for (int ring = 0; ring < 64; ++ring) {
      const double yaw = rad_from_deg(azimuth);
      const double pitch = rad_from_deg(-25.0 + 40.0 * ring / 63.0);
      const Eigen::Vector3d direction(std::cos(pitch) * std::cos(yaw),
                                      std::cos(pitch) * std::sin(yaw), std::sin(pitch));
      rays.push_back({T * Eigen::Vector3d(0.0, 0.0, 2.1), T.rotation * direction, 0.0});
    }
  }
  return rays;
}

double range_m(const Tree& tree, const Ray& ray) {
  const Kernel::Vector_3 direction(ray.direction.x(), ray.direction.y(), ray.direction.z());
  const auto hit = tree.first_intersection(Kernel::Ray_3(point_of(ray.origin), direction));
  if (!hit) return std::numeric_limits<double>::infinity();
  const auto* point = boost::get<Kernel::Point_3>(&hit->first);
  if (point == nullptr) return std::numeric_limits<double>::infinity();
  const double range = std::sqrt((*point - point_of(ray.origin)).squared_length());
  return range <= kMax_m ? range : std::numeric_limits<double>::infinity();
}

/// A ray through an edge may hit either side, so a few may differ.
void check(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const Tree& tree) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double other_m = range_m(tree, rays[i]);
    const bool is_same =
        hits[i].is_there() ? std::abs(hits[i].range_m - other_m) < 1e-3 : std::isinf(other_m);
    if (!is_same) ++different;
  }
  if (different * 1000 > rays.size()) {
    throw std::logic_error(std::to_string(different) + " of " + std::to_string(rays.size()) +
                           " rays differ between Embree and CGAL");
  }
}

void check_and_add() {
  const auto scene = std::make_shared<SimulatedScene>(std::make_shared<simulation::Recipe>(), 0);
  const auto triangles = std::make_shared<Triangles>(triangles_of(scene->world()));
  const auto tree = std::make_shared<Tree>(triangles->begin(), triangles->end());
  const auto rays = std::make_shared<std::vector<Ray>>(rays_of(*scene));
  check(*rays, scene->caster().cast(*rays, 0.0, kMax_m), *tree);
  const auto count = static_cast<std::int64_t>(rays->size());
  add("embree", benchmark::kMillisecond, [scene, rays, count](benchmark::State& state) {
    for (auto _ : state) {
      benchmark::DoNotOptimize(scene->caster().cast(*rays, 0.0, kMax_m).data());
    }
    state.SetItemsProcessed(state.iterations() * count);
  });
  add("cgal_aabb_tree", benchmark::kMillisecond,
      [tree, triangles, rays, count](benchmark::State& state) {
        for (auto _ : state) {
          double sum_m = 0.0;
          for (const Ray& ray : *rays) sum_m += range_m(*tree, ray);
          benchmark::DoNotOptimize(sum_m);
        }
        state.SetItemsProcessed(state.iterations() * count);
      });
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}
