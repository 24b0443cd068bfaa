#include "framework/simulation/mesh.hpp"

#include <array>
#include <cmath>

namespace croon::simulation {

const MaterialLook& look_of(Material material) {
  // In the order of the enumeration.
  static const std::array<MaterialLook, 19> looks = {{{0.17, 0.0, {88, 90, 94}},
                                                      {0.45, 0.25, {232, 232, 226}},
                                                      {0.35, 0.0, {166, 164, 158}},
                                                      {0.30, 0.0, {150, 144, 138}},
                                                      {0.50, 0.0, {108, 140, 82}},
                                                      {0.35, 0.0, {158, 98, 80}},
                                                      {0.60, 0.0, {212, 202, 184}},
                                                      {0.08, 0.0, {96, 122, 140}},
                                                      {0.40, 0.0, {140, 144, 150}},
                                                      {0.50, 0.0, {180, 62, 56}},
                                                      {0.70, 0.0, {226, 226, 222}},
                                                      {0.10, 0.0, {52, 54, 60}},
                                                      {0.35, 0.0, {58, 88, 140}},
                                                      {0.05, 0.0, {38, 38, 40}},
                                                      {0.30, 0.0, {104, 80, 60}},
                                                      {0.45, 0.0, {76, 120, 62}},
                                                      {0.40, 0.0, {70, 84, 140}},
                                                      {0.40, 0.0, {150, 116, 78}},
                                                      {0.40, 0.80, {60, 110, 190}}}};
  return looks[static_cast<std::size_t>(material)];
}

std::uint32_t Mesh::add_vertex(const Eigen::Vector3d& vertex) {
  vertices.push_back(vertex.cast<float>());
  return next_vertex() - 1;
}

void Mesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Material material) {
  triangles.push_back({a, b, c});
  materials.push_back(material);
}

void Mesh::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                    Material material) {
  add_triangle(a, b, c, material);
  add_triangle(a, c, d, material);
}

void Mesh::add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    const Eigen::Vector3d& d, Material material) {
  const std::uint32_t first = add_vertex(a);
  add_vertex(b);
  add_vertex(c);
  add_vertex(d);
  add_quad(first, first + 1, first + 2, first + 3, material);
}

void Mesh::append(const Mesh& other, const RigidTransform& T_this_other) {
  const auto first = next_vertex();
  const Points moved = transformed(other.vertices, T_this_other);
  vertices.insert(vertices.end(), moved.begin(), moved.end());
  for (const auto& [a, b, c] : other.triangles) {
    triangles.push_back({first + a, first + b, first + c});
  }
  materials.insert(materials.end(), other.materials.begin(), other.materials.end());
}

RigidTransform Body::pose_at(double time_s) const {
  const double turn_rad = motion.yaw_rate_radps * time_s;
  const double length_m = motion.speed_mps * time_s;
  // The body moves along an arc of this length, whose chord has the length 2 / curvature * sin(turn
  // / 2).
  const double half_rad = 0.5 * turn_rad;
  const double chord_m =
      std::abs(half_rad) < 1e-9 ? length_m : length_m * std::sin(half_rad) / half_rad;
  const RigidTransform moved = {rotation_from_rpy({0.0, 0.0, turn_rad}),
                                {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), 0.0}};
  return T_world_body * moved;
}

}  // namespace croon::simulation
