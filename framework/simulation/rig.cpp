#include "framework/simulation/rig.hpp"

#include <algorithm>
#include <array>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

Mounting mounted(const char* model, std::vector<double> rotation_rpy_deg,
                 std::vector<double> translation_m) {
  return {sensor_model(model), std::move(rotation_rpy_deg), std::move(translation_m), 0.0};
}

/// The car of the CARLA samples: the reference is 2.1 m above the road, the others are at the
/// bumpers and the edges of the roof, pitched down by 48 degrees. The poses are from the samples.
Rig croon_five() {
  Rig rig;
  rig.body = {4.72, 1.9, 1.45, true};
  rig.reference_height_m = 2.1;
  rig.reference_forward_m = -0.525;
  rig.sensors = {{"back", mounted("carla_pandar_qt", {0, 48, 180}, {-1.8, 0, -0.82})},
                 {"front", mounted("carla_pandar_qt", {0, 48, 0}, {2.9, 0.15, -1.195})},
                 {"left", mounted("carla_pandar_qt", {0, 48, -90}, {0.25, -0.85, -0.595})},
                 {"right", mounted("carla_pandar_qt", {0, 48, 90}, {0.25, 0.85, -0.595})},
                 {"top", mounted("carla_pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

/// The real car of the paper's samples: a roof rack with a Pandar64 and two PandarQTs. The poses
/// are the nominal poses of the samples.
Rig croon_three() {
  Rig rig;
  rig.body = {4.7, 1.85, 1.5, true};
  rig.reference_height_m = 2.05;
  rig.reference_forward_m = -0.2;
  rig.sensors = {{"left", mounted("pandar_qt", {-4.2, 45.1, 92.0}, {0.0, 0.56, -0.39})},
                 {"right", mounted("pandar_qt", {-0.5, 45.8, -86.3}, {-0.04, -0.57, -0.41})},
                 {"top", mounted("pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

/// The silhouette from the tail over the roof to the nose (x and z relative to the length and
/// height), measured from the points that the sensors of the paper's samples see on their car.
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

/// Half the width of the body at a relative length and height. The body is narrower from the
/// windows up to the roof, and towards nose and tail.
double half_width_m(const CarBody& body, double length_share, double height_share) {
  const auto narrowed = [](double share, double from, double to, double min_share) {
    return 1.0 - (1.0 - min_share) * std::clamp((share - from) / (to - from), 0.0, 1.0);
  };
  return 0.5 * body.width_m * narrowed(height_share, 0.6, 1.0, 0.72) *
         narrowed(length_share, 0.36, 0.5, 0.56) * narrowed(-length_share, 0.40, 0.5, 0.72);
}

/// Adds the hull over the silhouette: one band across the car, and its two sides.
void add_hull(Mesh& mesh, const CarBody& body) {
  constexpr auto kCorners = static_cast<std::uint32_t>(kSilhouette.size());
  std::array<std::uint32_t, 2> first{};
  std::array<std::uint32_t, 2> hub{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    first[side] = mesh.next_vertex();
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

RigidTransform Mounting::T_reference_sensor() const {
  const Eigen::Vector3d rpy_deg(rotation_rpy_deg[0], rotation_rpy_deg[1], rotation_rpy_deg[2]);
  return {rotation_from_rpy(rpy_deg * rad_from_deg(1.0)),
          {translation_m[0], translation_m[1], translation_m[2]}};
}

RigidTransform Rig::T_car_reference() const {
  return {Eigen::Matrix3d::Identity(), {reference_forward_m, 0.0, reference_height_m}};
}

const std::vector<std::pair<std::string, Rig>>& rigs() {
  static const std::vector<std::pair<std::string, Rig>> rigs = {{"croon_five", croon_five()},
                                                                {"croon_three", croon_three()}};
  return rigs;
}

Mesh make_own_car(const CarBody& body) {
  Mesh mesh;
  if (!body.is_visible) return mesh;
  add_hull(mesh, body);
  add_wheels(mesh, body);
  return mesh;
}

}  // namespace croon::simulation
