#include "framework/simulation/objects/facade.hpp"

#include <algorithm>

namespace croon::simulation {

using Eigen::Vector3d;

void add_wall(Mesh& mesh, const WallFrame& frame, const WallPart& part, Material material) {
  mesh.add_quad(frame.point(part.left_m, part.low_m), frame.point(part.right_m, part.low_m),
                frame.point(part.right_m, part.high_m), frame.point(part.left_m, part.high_m),
                material);
}

void add_opening(Mesh& mesh, const WallFrame& frame, const WallPart& part,
                 const Openings& openings) {
  const double middle_m = 0.5 * (part.left_m + part.right_m);
  const double half_m = std::min(0.5 * openings.width_m, 0.46 * (part.right_m - part.left_m));
  const double low_m = part.low_m + openings.sill_m;
  const WallPart hole = {middle_m - half_m, middle_m + half_m, low_m,
                         std::min(low_m + openings.height_m, part.high_m - 0.1)};
  add_wall(mesh, frame, {part.left_m, hole.left_m, part.low_m, part.high_m}, openings.wall);
  add_wall(mesh, frame, {hole.right_m, part.right_m, part.low_m, part.high_m}, openings.wall);
  add_wall(mesh, frame, {hole.left_m, hole.right_m, hole.high_m, part.high_m}, openings.wall);
  if (openings.sill_m > 0.0) {
    add_wall(mesh, frame, {hole.left_m, hole.right_m, part.low_m, hole.low_m}, openings.wall);
  }
  const double x[4] = {hole.left_m, hole.right_m, hole.right_m, hole.left_m};
  const double z[4] = {hole.low_m, hole.low_m, hole.high_m, hole.high_m};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    mesh.add_quad(frame.point(x[i], z[i]), frame.point(x[j], z[j]),
                  frame.point(x[j], z[j], openings.recess_m),
                  frame.point(x[i], z[i], openings.recess_m), openings.wall);
  }
  const WallFrame pane = {frame.point(0.0, 0.0, openings.recess_m), frame.along, frame.inwards};
  add_wall(mesh, pane, hole, openings.pane);
}

void add_relief(Mesh& mesh, const WallFrame& frame, const WallPart& part, double out_m,
                Material material) {
  const WallFrame outside = {frame.point(0.0, 0.0, -out_m), frame.along, frame.inwards};
  add_wall(mesh, outside, part, material);
  const double x[4] = {part.left_m, part.right_m, part.right_m, part.left_m};
  const double z[4] = {part.low_m, part.low_m, part.high_m, part.high_m};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    mesh.add_quad(frame.point(x[i], z[i]), frame.point(x[j], z[j]), outside.point(x[j], z[j]),
                  outside.point(x[i], z[i]), material);
  }
}

std::array<WallFrame, 4> walls_of(double width_m, double depth_m) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  return {{{{0.0, 0.0, 0.0}, x, y},
           {{width_m, 0.0, 0.0}, y, -x},
           {{width_m, depth_m, 0.0}, -x, -y},
           {{0.0, depth_m, 0.0}, -y, x}}};
}

}  // namespace croon::simulation
