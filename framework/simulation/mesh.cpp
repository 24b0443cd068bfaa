#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

std::uint32_t Mesh::add_vertex(const Eigen::Vector3d& vertex) {
  vertices.push_back(vertex.cast<float>());
  return static_cast<std::uint32_t>(vertices.size() - 1);
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
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const PointCloud moved = transformed(other.vertices, T_this_other);
  vertices.insert(vertices.end(), moved.begin(), moved.end());
  for (const auto& [a, b, c] : other.triangles) {
    triangles.push_back({first + a, first + b, first + c});
  }
  materials.insert(materials.end(), other.materials.begin(), other.materials.end());
}

}  // namespace croon::simulation
