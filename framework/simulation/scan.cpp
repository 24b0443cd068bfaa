#include "framework/simulation/scan.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// The sensor's own data of a ray.
struct Firing {
  Vector3d nominal_direction;  ///< In the sensor's frame.
  std::uint16_t ring = 0;
  double time_s = 0.0;  ///< By the sensor's clock.
};

/// An angle with its cosine and sine.
struct Angle {
  explicit Angle(double angle_rad)
      : rad(angle_rad), cosine(std::cos(angle_rad)), sine(std::sin(angle_rad)) {}
  double rad;
  double cosine;
  double sine;
};

Vector3d direction_of(const Angle& azimuth, const Angle& elevation) {
  return {elevation.cosine * azimuth.cosine, elevation.cosine * azimuth.sine, elevation.sine};
}

/// Fires the rays of a scan: all rings at one azimuth, then the next azimuth.
class Laser {
 public:
  Laser(const SensorModel& sensor, const Noise& noise, const ScanPlan& plan, const StreamKey& key)
      : sensor_(sensor),
        noise_(noise),
        plan_(plan),
        rng_(key),
        azimuths_deg_(azimuths_deg(sensor)) {
    for (const double angle_deg : sensor.elevations_deg) {
      elevations_.emplace_back(rad_from_deg(angle_deg));
    }
  }

  /// Replaces `rays` and `firings` by about a block of rays at the next azimuths; returns false if
  /// there are none. A block fits the cache and bounds the memory of a scan.
  bool fire_next(std::vector<Ray>& rays, std::vector<Firing>& firings) {
    constexpr std::size_t kBlock = 4096;
    rays.clear();
    firings.clear();
    for (; next_ < azimuths_deg_.size() && rays.size() < kBlock; ++next_) fire(rays, firings);
    return !rays.empty();
  }

 private:
  void fire(std::vector<Ray>& rays, std::vector<Firing>& firings) {
    const double share = static_cast<double>(next_) / static_cast<double>(azimuths_deg_.size());
    const double fired_s = plan_.begin_s + share * sensor_.period_s;
    const double time_s = noise_.moves_during_scan ? fired_s : 0.0;
    const RigidTransform T_world_sensor = plan_.T_world_sensor(time_s);
    const Angle azimuth(rad_from_deg(azimuths_deg_[next_]));
    const double jitter_rad = rad_from_deg(noise_.angle_std_deg);
    for (std::size_t ring = 0; ring < elevations_.size(); ++ring) {
      const Angle& elevation = elevations_[ring];
      const Vector3d nominal = direction_of(azimuth, elevation);
      Vector3d fired = nominal;
      if (jitter_rad > 0.0) {
        const double across = jitter_rad * rng_.normal();
        const double up = jitter_rad * rng_.normal();
        fired = direction_of(Angle(azimuth.rad + across), Angle(elevation.rad + up));
      }
      rays.push_back({T_world_sensor.translation, T_world_sensor.rotation * fired, time_s});
      firings.push_back(
          {nominal, static_cast<std::uint16_t>(ring), fired_s + plan_.clock_offset_s});
    }
  }

  const SensorModel& sensor_;
  const Noise& noise_;
  const ScanPlan& plan_;
  Rng rng_;
  std::vector<double> azimuths_deg_;
  std::vector<Angle> elevations_;
  std::size_t next_ = 0;  ///< The number of the next azimuth.
};

/// The share of light that a surface returns to the sensor: Lambert's cosine law, and the
/// retroreflection of signs and plates.
double signal_ratio(const Hit& hit) {
  const MaterialLook& look = look_of(hit.material);
  return look.reflectivity * hit.incidence_cos + look.retroreflection;
}

bool is_lost(const Noise& noise, const Hit& hit, Rng& rng) {
  if (noise.dropout_ratio <= 0.0 && noise.detection_range_m <= 0.0) return false;
  const double kept =
      (1.0 - noise.dropout_ratio) * detection_probability(noise, hit.range_m, signal_ratio(hit));
  return rng.uniform() >= kept;
}

}  // namespace

PointCloud scan(const RayCaster& world, const SensorModel& sensor, const Noise& noise,
                const ScanPlan& plan, const StreamKey& key) {
  Laser laser(sensor, noise, plan, key.with("firing"));
  Rng return_rng(key.with("return"));
  std::vector<Ray> rays;
  std::vector<Firing> firings;
  PointCloud result;
  std::vector<float> intensity;
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;
  while (laser.fire_next(rays, firings)) {
    const std::vector<Hit> hits = world.cast(rays, sensor.min_range_m, sensor.max_range_m);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].is_there() || is_lost(noise, hits[i], return_rng)) continue;
      double range_m = hits[i].range_m;
      if (noise.range_std_m > 0.0) range_m += noise.range_std_m * return_rng.normal();
      if (range_m <= 0.0) continue;  // Range noise must not place a point behind the sensor.
      result.points.push_back((range_m * firings[i].nominal_direction).cast<float>());
      intensity.push_back(
          static_cast<float>(std::round(255.0 * std::min(signal_ratio(hits[i]), 1.0))));
      ring.push_back(firings[i].ring);
      time_s.push_back(firings[i].time_s);
    }
  }
  result.channels = {make_channel(kIntensity, intensity), make_channel(kRing, ring),
                     make_channel(kTime, time_s)};
  return result;
}

}  // namespace croon::simulation
