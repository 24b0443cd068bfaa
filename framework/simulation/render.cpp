#include "framework/simulation/render.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kFar_m = 400.0;

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
}

Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  const auto mix = [&](std::uint8_t x, std::uint8_t y) {
    return channel((1.0 - share_of_b) * x + share_of_b * y);
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

/// A surface is brightest where it faces the eye, and fades into the haze.
Colour colour_of(const Hit& hit) {
  const Colour haze = {206, 222, 236};
  if (!hit.is_there()) return haze;
  const Colour& own = look_of(hit.material).colour;
  const double light = 0.45 + 0.6 * hit.incidence_cos;
  const Colour lit = {channel(light * own.red), channel(light * own.green),
                      channel(light * own.blue)};
  return mixed(lit, haze, 0.8 * (1.0 - std::exp(-hit.range_m / 150.0)));
}

}  // namespace

Camera looking_at(const Vector3d& eye, const Vector3d& target) {
  Camera camera;
  const Vector3d forward = (target - eye).normalized();
  const Vector3d left = Vector3d::UnitZ().cross(forward).normalized();
  camera.T_world_camera.rotation << forward, left, forward.cross(left);
  camera.T_world_camera.translation = eye;
  return camera;
}

Image render(const RayCaster& world, const Camera& camera) {
  const double focal_px = 0.5 * camera.width / std::tan(0.5 * rad_from_deg(camera.width_deg));
  std::vector<Ray> rays;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vector3d through(focal_px, 0.5 * camera.width - x - 0.5, 0.5 * camera.height - y - 0.5);
      rays.push_back({camera.T_world_camera.translation,
                      camera.T_world_camera.rotation * through.normalized(), 0.0});
    }
  }
  const std::vector<Hit> hits = world.cast(rays, 0.05, kFar_m);
  Image image(camera.width, camera.height);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const int pixel = static_cast<int>(i);
    image.at(pixel % camera.width, pixel / camera.width) = colour_of(hits[i]);
  }
  return image;
}

}  // namespace croon::simulation
