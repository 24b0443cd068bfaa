#include "framework/simulation/objects/over_road.hpp"
#include "framework/simulation/objects/tunnel_shape.hpp"

namespace croon::simulation {
namespace {

constexpr double kFoot_m = -1.0;
constexpr double kDado_m = 2.4;   ///< Up to where walls have niches.
constexpr double kNiche_m = 2.0;  ///< Length of a niche.

/// Places `step_m` apart from half a step after the tunnel's begin, as long as `length_m` has room.
std::vector<double> every(const Tunnel& tunnel, double step_m, double length_m) {
  std::vector<double> places;
  if (step_m <= 0.0) return places;
  for (double s_m = tunnel.along_m.from + 0.5 * step_m; s_m + length_m < tunnel.along_m.to;
       s_m += step_m) {
    places.push_back(s_m);
  }
  return places;
}

/// `profile` down to `low_m` at `d_m` on either side.
Profile with_feet(Profile profile, double d_m, double low_m) {
  profile.insert(profile.begin(), {d_m, low_m});
  profile.emplace_back(-d_m, low_m);
  return profile;
}

/// The lower part of the wall at `side`, a niche or none.
void add_low_wall(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel, double side,
                  const std::vector<double>& places, bool is_niche) {
  const double wall_m = side * tunnel.wall_m;
  const double back_m = side * (tunnel.wall_m + (is_niche ? tunnel.niche_depth_m : 0.0));
  const Profile profile = {{back_m, kFoot_m}, {back_m, kDado_m}};
  add_strip(mesh, road.rings(places, profile), Material::concrete);
  if (!is_niche) return;
  add_strip(mesh, road.rings(places, {{back_m, kDado_m}, {wall_m, kDado_m}}), Material::concrete);
  for (const double s_m : places) {
    mesh.add_quad(road.point(s_m, wall_m, kFoot_m), road.point(s_m, back_m, kFoot_m),
                  road.point(s_m, back_m, kDado_m), road.point(s_m, wall_m, kDado_m),
                  Material::concrete);
  }
}

/// Walls, niches and ceiling.
void add_lining(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  const Profile upper = with_feet(ceiling_of(tunnel), tunnel.wall_m, kDado_m);
  std::vector<Span> niches;
  for (const double s_m : every(tunnel, tunnel.niches_m, kNiche_m)) {
    niches.push_back({s_m, s_m + kNiche_m});
  }
  const auto add_piece = [&](const Span& along_m, bool is_niche) {
    const std::vector<double> places = places_between(along_m.from, along_m.to);
    add_strip(mesh, road.rings(places, upper), Material::concrete);
    for (const double side : {-1.0, 1.0}) {
      add_low_wall(mesh, road, tunnel, side, places, is_niche);
    }
  };
  for (const Span& niche : niches) add_piece(niche, true);
  for (const Span& plain : without(tunnel.along_m, niches)) add_piece(plain, false);
}

/// The hill around the tunnel and its faces at both ends.
void add_hill(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  const double outer_m = tunnel.outer_m;
  add_strip(
      mesh,
      road.rings(places_between(tunnel.along_m.from, tunnel.along_m.to), {{outer_m, kFoot_m},
                                                                          {outer_m, tunnel.top_m},
                                                                          {-outer_m, tunnel.top_m},
                                                                          {-outer_m, kFoot_m}}),
      Material::grass);
  Profile inside = ceiling_of(tunnel);
  Profile outside;
  const auto last = static_cast<double>(inside.size() - 1);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    outside.emplace_back(outer_m * (1.0 - 2.0 * static_cast<double>(i) / last), tunnel.top_m);
  }
  inside = with_feet(inside, tunnel.wall_m, kFoot_m);
  outside = with_feet(outside, outer_m, kFoot_m);
  for (const double s_m : {tunnel.along_m.from, tunnel.along_m.to}) {
    add_strip(mesh, {road.rings({s_m}, inside)[0], road.rings({s_m}, outside)[0]},
              Material::concrete);
  }
}

void add_lamps(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  constexpr double kLength_m = 1.2;
  const double high_m = tunnel.is_arched ? tunnel.height_m - 0.35 : tunnel.height_m;
  for (const double s_m : every(tunnel, tunnel.lamps_m, kLength_m)) {
    for (const double d_m : {-0.3 * tunnel.kerb_m, 0.3 * tunnel.kerb_m}) {
      const Profile lamp = box_profile({d_m - 0.15, high_m - 0.15}, {d_m + 0.15, high_m});
      add_loft(mesh, road.rings({s_m, s_m + kLength_m}, lamp), Material::glass);
    }
  }
}

void add_ribs(Mesh& mesh, const OverRoad& road, const Tunnel& tunnel) {
  constexpr double kThick_m = 0.4;
  constexpr double kOut_m = 0.3;
  const double high_m = ceiling_of(tunnel).front().y();
  for (const double s_m : every(tunnel, tunnel.ribs_m, kThick_m)) {
    for (const double side : {-1.0, 1.0}) {
      const double wall_m = side * tunnel.wall_m;
      const Profile rib = box_profile({wall_m - side * kOut_m, kFoot_m}, {wall_m, high_m});
      add_loft(mesh, road.rings({s_m, s_m + kThick_m}, rib), Material::concrete);
    }
  }
}

}  // namespace

Mesh make_tunnel(const Ground& ground, const Stretch& stretch, Rng& rng) {
  const Tunnel tunnel = draw_tunnel(ground.shape(), stretch, rng);
  const OverRoad road(ground);
  Mesh mesh;
  add_lining(mesh, road, tunnel);
  add_hill(mesh, road, tunnel);
  add_lamps(mesh, road, tunnel);
  add_ribs(mesh, road, tunnel);
  return mesh;
}

}  // namespace croon::simulation
