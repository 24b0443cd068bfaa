#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/draws.hpp"
#include "framework/simulation/ground.hpp"

// All objects of a scene. Their sizes and shapes depend on `rng` only. Unless stated otherwise, an
// object is in its own frame: z up, origin on the ground at its foot.

namespace croon::simulation {

/// The type of a vehicle.
enum class VehicleType { car, van, truck, bus };

/// A vehicle in its own frame: x forward, y left, z up, origin on the ground below its middle.
struct Vehicle {
  Mesh mesh;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Length, width with mirrors, height.
};

/// A vehicle of at most 1200 triangles: a car of 3.6 to 5 m, a van of 5 to 6.5 m, a truck of 7 to
/// 16 m or a bus of 11 to 18 m.
Vehicle make_vehicle(VehicleType type, Rng& rng);

/// A standing or walking person of 1.2 to 1.95 m who faces x; the origin is between the feet.
Mesh make_person(Rng& rng);

/// A tree of 4 to 12 m: trunk, a few boughs and a leafy crown.
Mesh make_tree(Rng& rng);
/// A round bush of 0.6 to 1.8 m.
Mesh make_bush(Rng& rng);
/// A cut hedge along x, from the origin to `length_m`, symmetric about y = 0. Single leaves
/// protrude by up to 7 cm.
Mesh make_hedge(double length_m, double height_m, double width_m, Rng& rng);
/// Tufts of high grass along x, from the origin to `length_m`, symmetric about y = 0.
Mesh make_tufts(double length_m, double width_m, Rng& rng);

// Street furniture faces x: a lamp's arm and a sign's plate do.

Mesh make_lamp(Rng& rng);
Mesh make_traffic_light(Rng& rng);
Mesh make_sign(Rng& rng);
Mesh make_bollard(Rng& rng);
Mesh make_bin(Rng& rng);
Mesh make_bench(Rng& rng);
/// A roof on posts with a back wall and ends of glass.
Mesh make_bus_stop(Rng& rng);
/// A gantry with signs across a road of `width_m` along y; the origin is on the centre line.
Mesh make_gantry(double width_m, Rng& rng);

/// The size of a building.
struct BuildingSize {
  double width_m = 15.0;  ///< Along the road.
  double depth_m = 10.0;  ///< Away from the road.
  int floors = 3;
};

/// A town house: recessed windows on all sides, a door, a plinth, cornices, sometimes balconies or
/// a ground floor of shop windows. Its front is the plane y = 0 and faces -y; x runs along the
/// front from 0 to the width. The walls go 1 m below the ground at z = 0. Balconies reach out to y
/// = -1.2 m.
Mesh make_building(const BuildingSize& size, Rng& rng);
/// A family house in the same frame, with a pitched roof, sometimes a porch or a garage.
Mesh make_house(Rng& rng);
/// A hall in the same frame: long walls with few openings, a flat roof.
Mesh make_hall(const BuildingSize& size, Rng& rng);

/// A line on the ground in world coordinates: at least two points, consecutive ones distinct.
using Path = std::vector<Eigen::Vector3d>;

// Barriers follow a path, which is their middle, and go 0.3 m below it. World coordinates.

/// A smooth wall.
Mesh make_wall(const Path& path, double height_m, double thickness_m, Material material);
/// A wall with a coping and with pillars of `height_m`.
Mesh make_garden_wall(const Path& path, double height_m, Rng& rng);
/// Posts and thin bars or boards with gaps between them.
Mesh make_fence(const Path& path, double height_m, Rng& rng);
/// A W-beam on either side of posts, 0.75 m high.
Mesh make_guard_rail(const Path& path, Rng& rng);
/// A concrete barrier with the profile of a Jersey barrier, 0.8 m high.
Mesh make_jersey_barrier(const Path& path);

// Structures over the road. World coordinates.

/// A tunnel over the piece `along_m` (s) of the carriageway and up to 3 m of its pavements: walls
/// with niches or ribs, an arched or flat ceiling, lamps, and a hill around it with a portal at
/// either end.
Mesh make_tunnel(const Ground& ground, const Span& along_m, Rng& rng);
/// A bridge across the road, whose deck covers the piece `along_m` (s): deck, parapets, abutments
/// with embankments of up to 40 m behind them, sometimes piers.
Mesh make_bridge(const Ground& ground, const Span& along_m, Rng& rng);

}  // namespace croon::simulation
