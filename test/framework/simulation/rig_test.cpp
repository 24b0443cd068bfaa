// Which sensors of the named rigs overlap, and that all are outside the hull of their car.
#include "framework/simulation/rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/angles.hpp"
#include "test/support/simulated_worlds.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;
using Pairs = std::set<std::pair<std::string, std::string>>;

const Rig& rig_of(const std::string& name) {
  const auto found = std::find_if(rigs().begin(), rigs().end(),
                                  [&](const auto& rig) { return rig.first == name; });
  return found->second;
}

RigidTransform T_car_sensor(const Rig& rig, const Mounting& mounting) {
  return rig.T_car_reference() * mounting.T_reference_sensor();
}

/// Whether `point`, in the sensor's frame, is in its field of view.
bool is_in_view(const SensorModel& sensor, const Vector3d& point) {
  const double azimuth_deg = deg_from_rad(std::atan2(point.y(), point.x()));
  const double elevation_deg = deg_from_rad(std::asin(point.z() / point.norm()));
  if (sensor.rosette_rays > 0) {
    const double off_axis_deg = deg_from_rad(std::acos(point.x() / point.norm()));
    return off_axis_deg < 0.5 * sensor.rosette_width_deg;
  }
  return azimuth_deg >= sensor.azimuth_from_deg && azimuth_deg < sensor.azimuth_to_deg &&
         elevation_deg >= sensor.elevations_deg.front() &&
         elevation_deg <= sensor.elevations_deg.back();
}

/// The pairs of sensors, each in alphabetical order, that both see one of the places up to 8 m
/// above the road and up to 40 m from the car.
Pairs overlapping(const Rig& rig) {
  Pairs pairs;
  for (double x = -40.0; x <= 40.0; x += 1.0) {
    for (double y = -40.0; y <= 40.0; y += 1.0) {
      for (double z = 0.0; z <= 8.0; z += 0.5) {
        std::vector<std::string> seeing;
        for (const auto& [name, mounting] : rig.sensors) {
          const Vector3d point = T_car_sensor(rig, mounting).inverse() * Vector3d(x, y, z);
          if (is_in_view(mounting.model, point)) seeing.push_back(name);
        }
        for (std::size_t i = 1; i < seeing.size(); ++i) {
          for (std::size_t k = 0; k < i; ++k) pairs.insert({seeing[k], seeing[i]});
        }
      }
    }
  }
  return pairs;
}

TEST(Rig, OnlyNeighboursOverlap) {
  EXPECT_EQ(overlapping(rig_of("van_ring_four")),
            (Pairs{{"back", "left"}, {"back", "right"}, {"front", "left"}, {"front", "right"}}));
  EXPECT_EQ(overlapping(rig_of("van_ring_six")), (Pairs{{"back", "rear_left"},
                                                        {"back", "rear_right"},
                                                        {"front", "front_left"},
                                                        {"front", "front_right"},
                                                        {"front_left", "rear_left"},
                                                        {"front_right", "rear_right"}}));
  EXPECT_EQ(overlapping(rig_of("tractor_trailer")), (Pairs{{"front_left", "front_right"},
                                                           {"front_left", "side_left"},
                                                           {"front_right", "side_right"},
                                                           {"rear", "side_left"},
                                                           {"rear", "side_right"}}));
  EXPECT_EQ(overlapping(rig_of("robot_two")), (Pairs{{"front", "mast"}, {"front", "rear"}}));
  EXPECT_EQ(overlapping(rig_of("roof_two")), (Pairs{{"left", "rear"}, {"left", "right"}}));
  EXPECT_EQ(overlapping(rig_of("livox_three")), (Pairs{{"left", "middle"}, {"middle", "right"}}));
}

TEST(Rig, NamesAreSortedAndTheReferenceIsAtZero) {
  for (const auto& [name, rig] : rigs()) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(std::is_sorted(rig.sensors.begin(), rig.sensors.end(),
                               [](const auto& a, const auto& b) { return a.first < b.first; }));
    const auto reference =
        std::find_if(rig.sensors.begin(), rig.sensors.end(),
                     [&, &own = rig](const auto& s) { return s.first == own.reference; });
    ASSERT_NE(reference, rig.sensors.end());
    const RigidTransform T = reference->second.T_reference_sensor();
    EXPECT_TRUE(T.rotation.isIdentity(0.0));
    EXPECT_TRUE(T.translation.isZero(0.0));
  }
}

TEST(Rig, SensorsOfPresetsAreWhereTheirCarHasThem) {
  const Rig& rig = rig_of("tractor_trailer");
  for (const auto& [name, mounting] : rig.sensors) {
    if (name != "rear") continue;
    const RigidTransform T = T_car_sensor(rig, mounting);
    EXPECT_LT((T.translation - Vector3d(-8.35, 0.0, 2.2)).norm(), 1e-5);
    EXPECT_NEAR(T.rotation(0, 0), -std::cos(rad_from_deg(6.0)), 1e-6);
  }
}

TEST(Rig, SensorsAreOutsideTheHullAndSeeLittleOfIt) {
  for (const auto& [name, rig] : rigs()) {
    const auto caster = test::caster_of(make_own_car(rig.body));
    for (const auto& [sensor, mounting] : rig.sensors) {
      SCOPED_TRACE(name + " " + sensor);
      const RigidTransform T = T_car_sensor(rig, mounting);
      // From inside, the closed hull would be above.
      EXPECT_FALSE(
          caster->cast({{T.translation, Vector3d::UnitZ(), 0.0}}, 0.0, 50.0)[0].is_there());
      if (name.rfind("croon", 0) == 0 || name == "roof_two") continue;  // These see their roof.
      std::vector<Ray> rays;
      for (double azimuth = 0.0; azimuth < 360.0; azimuth += 1.0) {
        for (double elevation = -89.0; elevation < 90.0; elevation += 1.0) {
          const double a = rad_from_deg(azimuth);
          const double e = rad_from_deg(elevation);
          const Vector3d d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
          if (is_in_view(mounting.model, d)) rays.push_back({T.translation, T.rotation * d, 0.0});
        }
      }
      const std::vector<Hit> hits = caster->cast(rays, 0.0, 50.0);
      const auto own =
          std::count_if(hits.begin(), hits.end(), [](auto& hit) { return hit.is_there(); });
      EXPECT_LE(own, static_cast<std::ptrdiff_t>(rays.size() / 50));
    }
  }
}

}  // namespace
}  // namespace croon::simulation
