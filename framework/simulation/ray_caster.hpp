#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "framework/simulation/world.hpp"

namespace croon::simulation {

/// A stretch of time, seconds.
struct TimeWindow {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// A ray of light in the world.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< Of length 1.
  double time_s = 0.0;                                   ///< In the caster's window.
};

/// Where a ray first meets a surface.
struct Hit {
  double range_m = std::numeric_limits<double>::infinity();  ///< Infinite where there is none.
  double incidence_cos = 0.0;  ///< Of the angle between the ray and the surface's normal, 0 to 1.
  Material material = Material::asphalt;

  bool is_there() const { return range_m < std::numeric_limits<double>::infinity(); }
};

/// Finds what rays meet in a world, with Embree's packets of eight. Embree tells the triangle, in
/// single precision; the range is then that of the triangle's plane, in double precision. Bodies
/// move in straight lines from where they are at the window's begin to where they are at its end.
/// The same bits on any number of threads; `cast` may be called from many.
class RayCaster {
 public:
  RayCaster(std::shared_ptr<const World> world, TimeWindow window);
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
