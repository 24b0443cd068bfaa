#include "framework/simulation/scenes/lanes.hpp"

#include <utility>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

VehicleType draw_type(const Traffic& traffic, Rng& rng) {
  const double share = rng.uniform();
  if (share < traffic.truck_share) return VehicleType::truck;
  if (share < traffic.truck_share + traffic.bus_share) return VehicleType::bus;
  return share > 0.85 ? VehicleType::van : VehicleType::car;
}

}  // namespace

std::vector<LaneLine> lane_lines(const Lanes& lanes, bool has_edges) {
  std::vector<LaneLine> lines;
  for (const double side : {-1.0, 1.0}) {
    if (lanes.half_median_m > 0.0) lines.push_back({side * lanes.half_median_m, false});
    for (int lane = 1; lane < lanes.each_way; ++lane) {
      lines.push_back({side * (lanes.half_median_m + lane * lanes.width_m), true});
    }
    if (has_edges) lines.push_back({side * lanes.edge_m(), false});
  }
  if (lanes.half_median_m == 0.0) lines.push_back({0.0, lanes.each_way == 1});
  return lines;
}

RoadPose draw_car_pose(const Lanes& lanes, int index, Rng& rng) {
  const double off_m = rng.uniform(-0.35, 0.35);
  const double yaw_rad = rad_from_deg(rng.uniform(-3.0, 3.0));
  return {0.0, -lanes.middle_m(index) + off_m, yaw_rad};
}

void add_traffic(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
                 const Traffic& traffic, Rng rng) {
  double rear_m = along_m.from + rng.uniform(0.0, traffic.gap_m.to);
  while (rear_m < along_m.to) {
    Vehicle vehicle = make_vehicle(draw_type(traffic, rng), rng);
    const double speed_mps = traffic.speed_mps * rng.uniform(0.9, 1.1);
    const double off_m = rng.uniform(-0.3, 0.3);
    const double turn_rad = kWithTraffic_rad + rad_from_deg(rng.uniform(-1.5, 1.5));
    const double length_m = vehicle.size_m.x();
    const RoadPose pose = side.at(rear_m + 0.5 * length_m, out_m + off_m, turn_rad);
    builder.drive(std::move(vehicle.mesh), pose, speed_mps);
    rear_m += length_m + draw(rng, traffic.gap_m);
  }
}

void add_traffic(SceneBuilder& builder, const Lanes& lanes, const Span& along_m,
                 const Traffic& traffic) {
  std::uint64_t stream = 0;
  for (const Roadside& side : both_sides()) {
    for (int lane = 0; lane < lanes.each_way; ++lane) {
      add_traffic(builder, side, along_m, lanes.middle_m(lane), traffic,
                  Rng(builder.key("traffic").with(stream++)));
    }
  }
}

}  // namespace croon::simulation
