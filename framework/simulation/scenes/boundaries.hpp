#pragma once

#include <array>

#include "framework/simulation/scenes/builder.hpp"

namespace croon::simulation {

enum class BoundaryType {
  garden_wall,
  fence,
  hedge,
  noise_wall,
  guard_rail,
  jersey_barrier,
  tufts
};

/// A barrier that follows a line on the ground.
struct Boundary {
  BoundaryType type = BoundaryType::fence;
  /// Of its occupied space, and of the barrier itself unless its type has a fixed height.
  double height_m = 1.2;
};

/// The line between two poses that is straight in road coordinates. Their yaw is not used.
using RoadLine = std::array<RoadPose, 2>;

/// Adds a barrier along `line` if its whole space is free.
bool add_boundary(SceneBuilder& builder, const RoadLine& line, const Boundary& boundary, Rng& rng);

/// Adds a barrier along a side at the distance `out_m`, in pieces of 10 m whose space is free.
void add_boundary_pieces(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                         double out_m, const Boundary& boundary, Rng rng);

/// A long wall without relief.
struct SmoothWall {
  Span along_m;
  double face_m = 5.0;  ///< Distance from the centre line to its face.
  double height_m = 5.0;
  Material material = Material::concrete;
};

/// Adds the wall, 1 m thick, and occupies its space and the 7 m behind it.
void add_smooth_wall(SceneBuilder& builder, const Roadside& side, const SmoothWall& wall);

/// Draws a paved road without kerbs, for walls at the distances `faces_m` on its two sides. The
/// magnitude of its grade is at most `max_grade`.
RoadShape draw_road_between_walls(const std::array<double, 2>& faces_m, double max_grade, Rng& rng);

/// Adds a flat ceiling between the faces of two walls, at the height of the lower one.
void add_ceiling(SceneBuilder& builder, const std::array<SmoothWall, 2>& walls);

/// Adds a bridge across the road over `along_m` and occupies its space, but not the carriageway
/// below 4.2 m. Call this function before objects beside and above the road are added.
void add_bridge(SceneBuilder& builder, const Span& along_m, Rng rng);

/// The same for a tunnel around the road.
void add_tunnel(SceneBuilder& builder, const Span& along_m, Rng rng);

}  // namespace croon::simulation
