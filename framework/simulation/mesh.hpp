#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/picture/colour.hpp"

namespace croon::simulation {

/// The material of a surface, which determines how much light it returns.
enum class Material : std::uint8_t {
  asphalt,
  marking,
  concrete,
  paving,
  grass,
  brick,
  plaster,
  glass,
  metal,
  paint,
  white_paint,
  black_paint,
  blue_paint,
  rubber,
  bark,
  leaf,
  cloth,
  wood,
  sign
};

/// The appearance of a material to a LiDAR and in a picture.
struct MaterialLook {
  double reflectivity = 0.0;  ///< Share of near-infrared light that a Lambertian surface scatters.
  double retroreflection = 0.0;  ///< Share that returns to the source at any angle of incidence.
  Colour colour;
};

/// The appearance of `material`. Reflectivities are for 905 nm, within the ranges quoted by
/// manufacturers of LiDARs and street furniture.
const MaterialLook& look_of(Material material);

/// Triangles with a material each, metres. Both sides of a triangle reflect light.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into `vertices`.
  std::vector<Material> materials;                      ///< One per triangle.

  /// The index of the next vertex to be added.
  std::uint32_t next_vertex() const { return static_cast<std::uint32_t>(vertices.size()); }
  /// Adds a vertex and returns its index.
  std::uint32_t add_vertex(const Eigen::Vector3d& vertex);
  /// Adds a triangle over three vertices, given by their indices.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Material material);
  /// Adds two triangles over the corners `a b c d`, in order around the quadrilateral.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                Material material);
  /// The same with new vertices.
  void add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d, Material material);
  /// Adds `other`, moved by `T_this_other`.
  void append(const Mesh& other, const RigidTransform& T_this_other);
};

/// The motion of a body, along its own x axis and about its own z axis, at constant rates.
struct Motion {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

/// A moving rigid object.
struct Body {
  Mesh mesh;  ///< In the body's frame: x forward, z up, origin on the ground below the body.
  RigidTransform T_world_body;  ///< At time 0.
  Motion motion;

  /// `T_world_body` at `time_s`.
  RigidTransform pose_at(double time_s) const;
};

/// Everything that rays can hit in one scene. World frame: origin near the car, z up, metres.
struct World {
  Mesh fixed;
  std::vector<Body> bodies;  ///< All moving objects except the car that carries the sensors.
  Body car;                  ///< The car that carries the sensors.
};

}  // namespace croon::simulation
