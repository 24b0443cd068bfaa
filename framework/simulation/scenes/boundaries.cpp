#include "framework/simulation/scenes/boundaries.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Points along a line on the ground, at most 3 m apart.
Path path_of(const Ground& ground, const RoadLine& line) {
  constexpr double kStep_m = 3.0;
  const double ds_m = line[1].s_m - line[0].s_m;
  const double dd_m = line[1].d_m - line[0].d_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::hypot(ds_m, dd_m) / kStep_m)));
  Path path;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    path.push_back(ground.point(line[0].s_m + share * ds_m, line[0].d_m + share * dd_m));
  }
  return path;
}

double half_thickness_m(BoundaryType type) {
  switch (type) {
    case BoundaryType::hedge:
      return 0.5;
    case BoundaryType::jersey_barrier:
    case BoundaryType::guard_rail:
      return 0.35;
    default:
      return 0.25;
  }
}

/// The pose of a row of plants along x that reaches from `from` to `to`.
RigidTransform frame_along(const Vector3d& from, const Vector3d& to) {
  RigidTransform frame;
  frame.rotation.col(0) = (to - from).normalized();
  frame.rotation.col(1) = Vector3d::UnitZ().cross(frame.rotation.col(0)).normalized();
  frame.rotation.col(2) = frame.rotation.col(0).cross(frame.rotation.col(1));
  frame.translation = from;
  return frame;
}

/// Plants along each piece of the path.
Mesh make_planted(const Path& path, const Boundary& boundary, Rng& rng) {
  Mesh mesh;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double length_m = (path[i + 1] - path[i]).norm();
    const Mesh piece = boundary.type == BoundaryType::hedge
                           ? make_hedge(length_m, boundary.height_m, 0.8, rng)
                           : make_tufts(length_m, 0.5, rng);
    mesh.append(piece, frame_along(path[i], path[i + 1]));
  }
  return mesh;
}

Mesh make_boundary(const Path& path, const Boundary& boundary, Rng& rng) {
  switch (boundary.type) {
    case BoundaryType::garden_wall:
      return make_garden_wall(path, boundary.height_m, rng);
    case BoundaryType::fence:
      return make_fence(path, boundary.height_m, rng);
    case BoundaryType::noise_wall:
      return make_wall(path, boundary.height_m, 0.2, Material::concrete);
    case BoundaryType::guard_rail:
      return make_guard_rail(path, rng);
    case BoundaryType::jersey_barrier:
      return make_jersey_barrier(path);
    case BoundaryType::hedge:
    case BoundaryType::tufts:
      break;
  }
  return make_planted(path, boundary, rng);
}

}  // namespace

bool add_boundary(SceneBuilder& builder, const RoadLine& line, const Boundary& boundary, Rng& rng) {
  const double half_m = half_thickness_m(boundary.type);
  const auto [s_low, s_high] = std::minmax(line[0].s_m, line[1].s_m);
  const auto [d_low, d_high] = std::minmax(line[0].d_m, line[1].d_m);
  const bool is_along = s_high - s_low > d_high - d_low;
  const double ahead_m = is_along ? 0.0 : half_m;
  const double aside_m = is_along ? half_m : 0.0;
  if (!builder.occupy(road_box({s_low - ahead_m, s_high + ahead_m},
                               {d_low - aside_m, d_high + aside_m}, boundary.height_m))) {
    return false;
  }
  builder.add(make_boundary(path_of(builder.ground(), line), boundary, rng));
  return true;
}

void add_boundary_pieces(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                         double out_m, const Boundary& boundary, Rng rng) {
  constexpr double kPiece_m = 10.0;
  for (double from_m = along_m.from; from_m < along_m.to; from_m += kPiece_m) {
    const double to_m = std::min(from_m + kPiece_m, along_m.to);
    add_boundary(builder, {side.at(from_m, out_m), side.at(to_m, out_m)}, boundary, rng);
  }
}

}  // namespace croon::simulation
