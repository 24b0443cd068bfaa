#include "framework/simulation/own_car.hpp"

#include <algorithm>
#include <array>

#include "framework/simulation/primitives.hpp"

namespace croon::simulation {
namespace {

/// The silhouette from the tail over the roof to the nose, shares of the length and of the height:
/// that of the car in the paper's samples, from the points that its own sensors see on it.
constexpr std::array<std::array<double, 2>, 18> kSilhouette = {{{-0.47, 0.18},
                                                                {-0.48, 0.40},
                                                                {-0.45, 0.64},
                                                                {-0.40, 0.75},
                                                                {-0.28, 0.90},
                                                                {-0.15, 0.97},
                                                                {-0.09, 1.00},
                                                                {-0.02, 0.99},
                                                                {0.04, 0.96},
                                                                {0.12, 0.88},
                                                                {0.205, 0.79},
                                                                {0.29, 0.66},
                                                                {0.374, 0.59},
                                                                {0.42, 0.51},
                                                                {0.45, 0.44},
                                                                {0.47, 0.36},
                                                                {0.475, 0.28},
                                                                {0.47, 0.18}}};

/// Half the width at shares of the length and of the height: narrower from the windows up to the
/// roof, and towards nose and tail.
double half_width_m(const CarBody& body, double length_share, double height_share) {
  const auto narrowed = [](double share, double from, double to, double least) {
    return 1.0 - (1.0 - least) * std::clamp((share - from) / (to - from), 0.0, 1.0);
  };
  return 0.5 * body.width_m * narrowed(height_share, 0.6, 1.0, 0.72) *
         narrowed(length_share, 0.36, 0.5, 0.56) * narrowed(-length_share, 0.40, 0.5, 0.72);
}

/// The hull over the silhouette: one band across the car, and its two sides.
void add_hull(Mesh& mesh, const CarBody& body) {
  constexpr auto kCorners = static_cast<std::uint32_t>(kSilhouette.size());
  std::array<std::uint32_t, 2> first{};
  std::array<std::uint32_t, 2> hub{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    first[side] = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, z] : kSilhouette) {
      mesh.add_vertex({x * body.length_m, sign * half_width_m(body, x, z), z * body.height_m});
    }
    hub[side] = mesh.add_vertex({0.0, sign * half_width_m(body, 0.0, 0.5), 0.5 * body.height_m});
  }
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const std::uint32_t next = (i + 1) % kCorners;
    mesh.add_quad(first[0] + i, first[0] + next, first[1] + next, first[1] + i, Material::paint);
    for (std::size_t side = 0; side < 2; ++side) {
      mesh.add_triangle(hub[side], first[side] + i, first[side] + next, Material::paint);
    }
  }
}

void add_wheels(Mesh& mesh, const CarBody& body) {
  constexpr double kRadius_m = 0.31;
  constexpr double kWidth_m = 0.2;
  for (const double x : {-0.28 * body.length_m, 0.30 * body.length_m}) {
    for (const double side : {-1.0, 1.0}) {
      const double outside_m = side * (0.46 * body.width_m);
      add_cylinder(mesh, {x, outside_m, kRadius_m}, {x, outside_m - side * kWidth_m, kRadius_m},
                   kRadius_m, kRadius_m, 14, Material::rubber);
    }
  }
}

}  // namespace

Mesh make_own_car(const CarBody& body) {
  Mesh mesh;
  if (!body.is_visible) return mesh;
  add_hull(mesh, body);
  add_wheels(mesh, body);
  return mesh;
}

}  // namespace croon::simulation
