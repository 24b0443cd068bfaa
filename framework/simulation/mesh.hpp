#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/simulation/material.hpp"

namespace croon::simulation {

/// Triangles with a material each, metres. Both sides of a triangle send light back.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into `vertices`.
  std::vector<Material> materials;                      ///< One per triangle.

  /// Adds a vertex and returns its index.
  std::uint32_t add_vertex(const Eigen::Vector3d& vertex);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Material material);
  /// Two triangles over the corners `a b c d`, in order around it.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                Material material);
  /// The same with new vertices.
  void add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d, Material material);
  /// Adds `other`, moved by `T_this_other`.
  void append(const Mesh& other, const RigidTransform& T_this_other);
};

}  // namespace croon::simulation
