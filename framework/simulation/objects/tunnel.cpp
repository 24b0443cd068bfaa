#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/profiles.hpp"

namespace croon::simulation {
namespace {

constexpr double kTunnelFoot_m = -1.0;
constexpr double kDado_m = 2.4;   ///< Height of the niches.
constexpr double kNiche_m = 2.0;  ///< Length of a niche.

/// The dimensions of a tunnel. Lateral positions are relative to the centre line of the road.
struct Tunnel {
  Span along_m;
  double kerb_m = 4.0;   ///< End of the carriageway.
  double wall_m = 6.0;   ///< Position of the walls.
  double outer_m = 9.0;  ///< End of the hill around the tunnel.
  double height_m = 6.0;
  double top_m = 8.0;  ///< Height of the hill.
  bool is_arched = false;
  double niches_m = 0.0;  ///< Distance from one niche to the next; 0: none.
  double ribs_m = 0.0;    ///< The same for ribs.
  double lamps_m = 8.0;   ///< The same for lamps.
  double niche_depth_m = 0.8;
};

Tunnel draw_tunnel(const RoadShape& shape, const Span& along_m, Rng& rng) {
  Tunnel tunnel;
  tunnel.along_m = along_m;
  tunnel.kerb_m = shape.half_width_m;
  tunnel.wall_m =
      shape.half_width_m + std::clamp(shape.pavement_width_m, 0.8, 3.0) + rng.uniform(0.0, 0.4);
  tunnel.outer_m = tunnel.wall_m + rng.uniform(2.0, 6.0);
  tunnel.is_arched = chance(rng, 0.5);
  tunnel.height_m = rng.uniform(5.2, 6.5) + (tunnel.is_arched ? 0.8 : 0.0);
  tunnel.top_m = tunnel.height_m + rng.uniform(1.0, 3.0);
  const bool has_niches = chance(rng, 0.5);
  const double every_m = rng.uniform(8.0, 16.0);
  tunnel.niches_m = has_niches ? 2.0 * every_m : 0.0;
  tunnel.ribs_m = has_niches ? 0.0 : every_m;
  tunnel.lamps_m = rng.uniform(6.0, 12.0);
  tunnel.niche_depth_m = rng.uniform(0.5, 1.0);
  return tunnel;
}

/// The ceiling from wall to wall.
Profile ceiling_of(const Tunnel& tunnel) {
  const double wall_m = tunnel.wall_m;
  if (!tunnel.is_arched) return {{wall_m, tunnel.height_m}, {-wall_m, tunnel.height_m}};
  constexpr int kSides = 12;
  constexpr double kClear_m = 4.8;
  // The upper half of an ellipse above `spring_m`, with room for trucks above the kerbs.
  const double ratio = std::sqrt(1.0 - std::pow(tunnel.kerb_m / wall_m, 2));
  const double spring_m = std::max(2.8, (kClear_m - ratio * tunnel.height_m) / (1.0 - ratio));
  Profile ceiling;
  for (int i = 0; i <= kSides; ++i) {
    const double angle = kPi * i / kSides;
    ceiling.emplace_back(i == kSides ? -wall_m : wall_m * std::cos(angle),
                         spring_m + (tunnel.height_m - spring_m) * std::sin(angle));
  }
  return ceiling;
}

/// Pieces of the tunnel, each `length_m` long, at intervals of `step_m`. The first one begins half
/// a step into the tunnel.
std::vector<Span> every(const Tunnel& tunnel, double step_m, double length_m) {
  std::vector<Span> pieces_m;
  if (step_m <= 0.0) return pieces_m;
  for (double s_m = tunnel.along_m.from + 0.5 * step_m; s_m + length_m < tunnel.along_m.to;
       s_m += step_m) {
    pieces_m.push_back({s_m, s_m + length_m});
  }
  return pieces_m;
}

/// `profile` with a corner at `d_m` to either side and the height `low_m` before and behind it.
Profile with_feet(Profile profile, double d_m, double low_m) {
  profile.insert(profile.begin(), {d_m, low_m});
  profile.emplace_back(-d_m, low_m);
  return profile;
}

/// Adds the lower part of the wall on one side, which is a niche or plain.
void add_low_wall(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel, double side,
                  const std::vector<double>& stations_m, bool is_niche) {
  const double wall_m = side * tunnel.wall_m;
  const double back_m = side * (tunnel.wall_m + (is_niche ? tunnel.niche_depth_m : 0.0));
  const Profile profile = {{back_m, kTunnelFoot_m}, {back_m, kDado_m}};
  add_strip(mesh, road.rings(stations_m, profile), Material::concrete);
  if (!is_niche) return;
  add_strip(mesh, road.rings(stations_m, {{back_m, kDado_m}, {wall_m, kDado_m}}),
            Material::concrete);
  for (const double s_m : stations_m) {
    mesh.add_quad(road.point(s_m, wall_m, kTunnelFoot_m), road.point(s_m, back_m, kTunnelFoot_m),
                  road.point(s_m, back_m, kDado_m), road.point(s_m, wall_m, kDado_m),
                  Material::concrete);
  }
}

/// Adds walls, niches and ceiling.
void add_lining(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  const Profile upper = with_feet(ceiling_of(tunnel), tunnel.wall_m, kDado_m);
  const std::vector<Span> niches = every(tunnel, tunnel.niches_m, kNiche_m);
  const auto add_piece = [&](const Span& along_m, bool is_niche) {
    const std::vector<double> stations_m = stations_between(along_m);
    add_strip(mesh, road.rings(stations_m, upper), Material::concrete);
    for (const double side : {-1.0, 1.0}) {
      add_low_wall(mesh, road, tunnel, side, stations_m, is_niche);
    }
  };
  for (const Span& niche : niches) add_piece(niche, true);
  for (const Span& plain : without(tunnel.along_m, niches)) add_piece(plain, false);
}

/// Adds the hill around the tunnel and the walls at both portals.
void add_hill(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  const double outer_m = tunnel.outer_m;
  const Profile hill =
      with_feet({{outer_m, tunnel.top_m}, {-outer_m, tunnel.top_m}}, outer_m, kTunnelFoot_m);
  add_strip(mesh, road.rings(stations_between(tunnel.along_m), hill), Material::grass);
  Profile inside = ceiling_of(tunnel);
  Profile outside;
  const auto last = static_cast<double>(inside.size() - 1);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    outside.emplace_back(outer_m * (1.0 - 2.0 * static_cast<double>(i) / last), tunnel.top_m);
  }
  inside = with_feet(inside, tunnel.wall_m, kTunnelFoot_m);
  outside = with_feet(outside, outer_m, kTunnelFoot_m);
  for (const double s_m : {tunnel.along_m.from, tunnel.along_m.to}) {
    add_strip(mesh, {road.rings({s_m}, inside)[0], road.rings({s_m}, outside)[0]},
              Material::concrete);
  }
}

void add_lamps(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  constexpr double kLength_m = 1.2;
  const double high_m = tunnel.is_arched ? tunnel.height_m - 0.35 : tunnel.height_m;
  for (const Span& piece_m : every(tunnel, tunnel.lamps_m, kLength_m)) {
    for (const double d_m : {-0.3 * tunnel.kerb_m, 0.3 * tunnel.kerb_m}) {
      const Profile lamp = box_profile({d_m - 0.15, high_m - 0.15}, {d_m + 0.15, high_m});
      add_loft(mesh, road.rings({piece_m.from, piece_m.to}, lamp), Material::glass);
    }
  }
}

void add_ribs(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  constexpr double kThick_m = 0.4;
  constexpr double kOut_m = 0.3;
  const double high_m = ceiling_of(tunnel).front().y();
  for (const Span& piece_m : every(tunnel, tunnel.ribs_m, kThick_m)) {
    for (const double side : {-1.0, 1.0}) {
      const double wall_m = side * tunnel.wall_m;
      const Profile rib = box_profile({wall_m - side * kOut_m, kTunnelFoot_m}, {wall_m, high_m});
      add_loft(mesh, road.rings({piece_m.from, piece_m.to}, rib), Material::concrete);
    }
  }
}

}  // namespace

Mesh make_tunnel(const Ground& ground, const Span& along_m, Rng& rng) {
  const Tunnel tunnel = draw_tunnel(ground.shape(), along_m, rng);
  const OverRoad road(ground);
  Mesh mesh;
  add_lining(mesh, road, tunnel);
  add_hill(mesh, road, tunnel);
  add_lamps(mesh, road, tunnel);
  add_ribs(mesh, road, tunnel);
  return mesh;
}

}  // namespace croon::simulation
