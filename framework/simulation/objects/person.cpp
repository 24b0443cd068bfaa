#include <cmath>

#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

// Lengths below are relative to the body's height (after Drillis and Contini, 1966).
constexpr double kThigh = 0.245;
constexpr double kShin = 0.24;
constexpr double kAnkle = 0.04;
constexpr double kUpperArm = 0.18;
constexpr double kForearm = 0.2;
// There is no material for skin; plaster has the same reflectivity.
constexpr Material kSkin = Material::plaster;

/// The posture of a standing or walking person.
struct Posture {
  double height_m = 1.7;
  double girth_ratio = 1.0;  ///< Width of the body relative to the average.
  double stride_rad = 0.0;   ///< Angle of the front leg from the vertical; 0: standing.
  double elbow_rad = 0.2;
  double lead = 1.0;  ///< 1: the left leg is in front; -1: the right.
};

Posture draw_posture(Rng& rng) {
  Posture posture;
  posture.height_m = rng.uniform(1.25, 1.95);
  posture.girth_ratio = rng.uniform(0.85, 1.3);
  const bool is_walking = chance(rng, 0.6);
  const double stride_rad = rng.uniform(0.15, 0.45);
  posture.stride_rad = is_walking ? stride_rad : 0.1 * stride_rad;
  posture.elbow_rad = rng.uniform(0.1, 0.9);
  posture.lead = draw_sign(rng);
  return posture;
}

/// The end of a limb of `length_m` that begins at `from`. The angle is 0 straight down and positive
/// forward.
Vector3d swung(const Vector3d& from, double angle_rad, double length_m) {
  return from + length_m * Vector3d(std::sin(angle_rad), 0.0, -std::cos(angle_rad));
}

double hip_height_m(const Posture& posture) {
  return posture.height_m * (kAnkle + (kThigh + kShin) * std::cos(posture.stride_rad));
}

/// Adds the leg of `side` (1: left). The rear leg bends at the knee.
void add_leg(Mesh& mesh, const Posture& posture, double side) {
  const double h = posture.height_m;
  const double girth_m = h * posture.girth_ratio;
  const bool is_front = side == posture.lead;
  const double thigh_rad = is_front ? posture.stride_rad : -0.6 * posture.stride_rad;
  const double shin_rad = is_front ? posture.stride_rad : -1.4 * posture.stride_rad;
  const Vector3d hip(0.0, side * 0.052 * girth_m, hip_height_m(posture));
  const Vector3d knee = swung(hip, thigh_rad, kThigh * h);
  const Vector3d ankle = swung(knee, shin_rad, kShin * h);
  add_cylinder(mesh, hip, knee, 0.05 * girth_m, 0.036 * girth_m, 6, Material::cloth);
  add_cylinder(mesh, knee, ankle, 0.035 * girth_m, 0.025 * girth_m, 6, Material::cloth);
  const double foot_half_m = 0.025 * h;
  add_box(mesh, ankle + Vector3d(-0.045 * h, -foot_half_m, -kAnkle * h),
          ankle + Vector3d(0.105 * h, foot_half_m, 0.015 * h), Material::rubber);
}

/// Adds the arm of `side`, which swings against the leg.
void add_arm(Mesh& mesh, const Posture& posture, const Vector3d& shoulder, double side) {
  const double h = posture.height_m;
  const double swing_rad = -side * posture.lead * 1.2 * posture.stride_rad;
  const Vector3d elbow = swung(shoulder, swing_rad, kUpperArm * h);
  const Vector3d hand = swung(elbow, swing_rad + posture.elbow_rad, kForearm * h);
  add_cylinder(mesh, shoulder, elbow, 0.03 * h, 0.025 * h, 5, Material::cloth);
  add_cylinder(mesh, elbow, hand, 0.024 * h, 0.018 * h, 5, Material::cloth);
  add_box(mesh, hand - Vector3d(0.02, 0.02, 0.06), hand + Vector3d(0.03, 0.02, 0.02), kSkin);
}

/// A cross-section of the trunk, relative to the body's height.
struct Girth {
  double above_hip, half_depth, half_width;
};

void add_trunk(Mesh& mesh, const Posture& posture) {
  static const std::vector<Girth> girths = {{-0.05, 0.045, 0.075}, {0.0, 0.068, 0.094},
                                            {0.1, 0.06, 0.08},     {0.22, 0.068, 0.11},
                                            {0.29, 0.055, 0.115},  {0.325, 0.032, 0.045}};
  const double h = posture.height_m;
  const double girth_m = h * posture.girth_ratio;
  const auto at = [&](double above_hip) {
    return Vector3d(0.0, 0.0, hip_height_m(posture) + above_hip * h);
  };
  std::vector<Ring> rings;
  for (const Girth& girth : girths) {
    Ring ring;
    for (const Eigen::Vector2d& unit : regular_polygon(1.0, 8)) {
      const Vector3d off(girth.half_depth * unit.x(), girth.half_width * unit.y(), 0.0);
      ring.push_back(at(girth.above_hip) + girth_m * off);
    }
    rings.push_back(ring);
  }
  add_loft(mesh, rings, Material::cloth);
  add_cylinder(mesh, at(0.31), at(0.37), 0.034 * h, 0.03 * h, 5, kSkin);
  // With straight legs, the top of the head is at the height of the body.
  const double top = 1.0 - kAnkle - kThigh - kShin;
  add_ellipsoid(mesh, at(top - 0.068), {0.056 * h, 0.047 * h, 0.068 * h}, 8, kSkin);
}

}  // namespace

Mesh make_person(Rng& rng) {
  Mesh mesh;
  const Posture posture = draw_posture(rng);
  add_trunk(mesh, posture);
  for (const double side : {1.0, -1.0}) {
    add_leg(mesh, posture, side);
    const Vector3d shoulder(0.0, side * 0.115 * posture.height_m * posture.girth_ratio,
                            hip_height_m(posture) + 0.285 * posture.height_m);
    add_arm(mesh, posture, shoulder, side);
  }
  return mesh;
}

}  // namespace croon::simulation
