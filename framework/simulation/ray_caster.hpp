#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "framework/simulation/draws.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A ray of light in the world.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< A unit vector.
  double time_s = 0.0;                                   ///< In the caster's time window.
};

/// The first hit of a ray on a surface.
struct Hit {
  double range_m = std::numeric_limits<double>::infinity();  ///< Infinite if there is no surface.
  double incidence_cos = 0.0;  ///< Of the angle between the ray and the surface's normal, 0 to 1.
  Material material = Material::asphalt;

  bool is_there() const { return range_m < std::numeric_limits<double>::infinity(); }
};

/// Finds the first surface that each ray hits, with Embree's packets of eight rays. Embree finds
/// the triangle in single precision; the range to its plane is computed in double precision. Within
/// steps of at most 0.1 s of the time window, bodies move in straight lines. Results are bitwise
/// independent of the number of threads. `cast` is thread-safe.
class RayCaster {
 public:
  RayCaster(std::shared_ptr<const World> world, Span window_s);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// The first hit of each ray between `min_m` and `max_m`.
  std::vector<Hit> cast(const std::vector<Ray>& rays, double min_m, double max_m) const;

 private:
  class Embree;

  std::shared_ptr<const World> world_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace croon::simulation
