#include "framework/simulation/own_car.hpp"

#include <algorithm>
#include <array>

#include "framework/simulation/primitives.hpp"

namespace croon::simulation {
namespace {

/// The silhouette from the tail over the roof to the nose: shares of the length and of the height.
constexpr std::array<std::array<double, 2>, 13> kSilhouette = {{{-0.49, 0.16},
                                                                {-0.50, 0.35},
                                                                {-0.49, 0.62},
                                                                {-0.46, 0.72},
                                                                {-0.37, 0.92},
                                                                {-0.25, 0.985},
                                                                {-0.08, 1.00},
                                                                {0.06, 0.96},
                                                                {0.22, 0.72},
                                                                {0.38, 0.64},
                                                                {0.47, 0.55},
                                                                {0.50, 0.40},
                                                                {0.49, 0.16}}};

/// Half the width at a share of the height: full up to the windows, then narrower up to the roof.
double half_width_m(const CarBody& body, double height_share) {
  constexpr double kWindows = 0.64;
  constexpr double kRoof = 0.76;  // Of the full width.
  const double up = std::clamp((height_share - kWindows) / (1.0 - kWindows), 0.0, 1.0);
  return 0.5 * body.width_m * (1.0 - up * (1.0 - kRoof));
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
      mesh.add_vertex({x * body.length_m, sign * half_width_m(body, z), z * body.height_m});
    }
    hub[side] = mesh.add_vertex({0.0, sign * half_width_m(body, 0.5), 0.5 * body.height_m});
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
  for (const double x : {-0.31 * body.length_m, 0.31 * body.length_m}) {
    for (const double side : {-1.0, 1.0}) {
      const double outside_m = side * (0.5 * body.width_m + 0.01);
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
