#include "framework/simulation/scan.hpp"

#include <algorithm>
#include <array>
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

/// Fires the rays of a scan: all rings at one azimuth, then the next azimuth; or the rays of a
/// rosette one by one.
class Laser {
 public:
  Laser(const SensorModel& sensor, const Noise& noise, const ScanPlan& plan, const StreamKey& key)
      : sensor_(sensor), noise_(noise), plan_(plan), rng_(key) {
    if (sensor.rosette_rays > 0) {
      // The petals of two scans do not coincide.
      Rng phase_rng(key.with("phase"));
      for (double& phase_rad : phases_rad_) phase_rad = phase_rng.uniform(0.0, 2.0 * kPi);
      steps_ = static_cast<std::size_t>(sensor.rosette_rays);
      return;
    }
    azimuths_deg_ = azimuths_deg(sensor);
    steps_ = azimuths_deg_.size();
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
    for (; next_ < steps_ && rays.size() < kBlock; ++next_) fire(rays, firings);
    return !rays.empty();
  }

 private:
  void fire(std::vector<Ray>& rays, std::vector<Firing>& firings) {
    const double share = static_cast<double>(next_) / static_cast<double>(steps_);
    const double fired_s = plan_.begin_s + share * sensor_.period_s;
    const double time_s = noise_.moves_during_scan ? fired_s : 0.0;
    const RigidTransform T_world_sensor = plan_.T_world_sensor(time_s);
    const Angle azimuth(next_azimuth_rad(share * sensor_.period_s));
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

  /// Replaces the elevations by that of a rosette.
  double next_azimuth_rad(double time_s) {
    if (sensor_.rosette_rays == 0) return rad_from_deg(azimuths_deg_[next_]);
    const auto [azimuth_rad, elevation_rad] = rosette_angles_rad(sensor_, phases_rad_, time_s);
    elevations_.assign(1, Angle(elevation_rad));
    return azimuth_rad;
  }

  const SensorModel& sensor_;
  const Noise& noise_;
  const ScanPlan& plan_;
  Rng rng_;
  std::vector<double> azimuths_deg_;
  std::vector<Angle> elevations_;
  std::array<double, 2> phases_rad_{};  ///< Of the prisms of a rosette.
  std::size_t steps_ = 0;               ///< Azimuths, or rays of a rosette.
  std::size_t next_ = 0;                ///< The number of the next one.
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

/// Mixes the ranges of rays that straddle an edge.
class Footprint {
 public:
  Footprint(const RayCaster& world, const SensorModel& sensor, double diameter_deg,
            const StreamKey& key)
      : world_(world), sensor_(sensor), radius_rad_(0.5 * rad_from_deg(diameter_deg)), rng_(key) {}

  /// Changes the ranges of `hits` of `rays`. Two opposite rays of each footprint are cast. Inverse
  /// ranges on a plane are linear in the direction, so an edge is where they are not.
  void mix(const std::vector<Ray>& rays, std::vector<Hit>& hits) {
    // Echoes farther apart are told apart, so only the first counts.
    constexpr double kSeparated_m = 2.0;
    constexpr double kBend_m = 0.05;
    std::vector<Ray> beside;
    for (const Ray& ray : rays) {
      const double angle_rad = rng_.uniform(0.0, 2.0 * kPi);
      const double offset = radius_rad_ * std::sqrt(rng_.uniform());
      const Vector3d across = ray.direction.unitOrthogonal();
      const Vector3d shift = offset * (std::cos(angle_rad) * across +
                                       std::sin(angle_rad) * ray.direction.cross(across));
      beside.push_back({ray.origin, (ray.direction + shift).normalized(), ray.time_s});
      beside.push_back({ray.origin, (ray.direction - shift).normalized(), ray.time_s});
    }
    const std::vector<Hit> others = world_.cast(beside, sensor_.min_range_m, sensor_.max_range_m);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const double share = rng_.uniform(0.0, 0.5);  // The middle is on the larger surface.
      if (!hits[i].is_there()) continue;
      double& range_m = hits[i].range_m;
      const double a_m = others[2 * i].range_m;
      const double b_m = others[2 * i + 1].range_m;
      const double bend_m = range_m * std::abs(2.0 - range_m / a_m - range_m / b_m);
      const double other_m = std::abs(a_m - range_m) > std::abs(b_m - range_m) ? a_m : b_m;
      if (bend_m > kBend_m && std::abs(other_m - range_m) < kSeparated_m) {
        range_m += share * (other_m - range_m);
      }
    }
  }

 private:
  const RayCaster& world_;
  const SensorModel& sensor_;
  double radius_rad_;
  Rng rng_;
};

}  // namespace

PointCloud scan(const RayCaster& world, const SensorModel& sensor, const Noise& noise,
                const ScanPlan& plan, const StreamKey& key) {
  Laser laser(sensor, noise, plan, key.with("firing"));
  Footprint footprint(world, sensor, noise.footprint_deg, key.with("footprint"));
  Rng return_rng(key.with("return"));
  std::vector<Ray> rays;
  std::vector<Firing> firings;
  PointCloud result;
  std::vector<float> intensity;
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;
  while (laser.fire_next(rays, firings)) {
    std::vector<Hit> hits = world.cast(rays, sensor.min_range_m, sensor.max_range_m);
    if (noise.footprint_deg > 0.0) footprint.mix(rays, hits);
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
  result.channels = {make_channel(kIntensity, intensity)};
  if (sensor.rosette_rays == 0) result.channels.push_back(make_channel(kRing, ring));
  result.channels.push_back(make_channel(kTime, time_s));
  return result;
}

}  // namespace croon::simulation
