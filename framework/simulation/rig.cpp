#include "framework/simulation/rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/exact_rpy.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

RigidTransform pose_of(const std::vector<double>& rpy_deg, const std::vector<double>& position_m) {
  const Eigen::Vector3d rpy(rpy_deg[0], rpy_deg[1], rpy_deg[2]);
  return {rotation_from_rpy(rpy * rad_from_deg(1.0)),
          {position_m[0], position_m[1], position_m[2]}};
}

Mounting mounted(const char* model, std::vector<double> rotation_rpy_deg,
                 std::vector<double> translation_m) {
  return {sensor_model(model), std::move(rotation_rpy_deg), std::move(translation_m), 0.0};
}

/// The car of the CARLA samples: the reference is 2.1 m above the road, the others are at the
/// bumpers and the edges of the roof, pitched down by 48 degrees. The poses are from the samples.
Rig croon_five() {
  Rig rig;
  rig.body = {4.72, 1.9, 1.45, true};
  rig.reference_height_m = 2.1;
  rig.reference_forward_m = -0.525;
  rig.sensors = {{"back", mounted("carla_pandar_qt", {0, 48, 180}, {-1.8, 0, -0.82})},
                 {"front", mounted("carla_pandar_qt", {0, 48, 0}, {2.9, 0.15, -1.195})},
                 {"left", mounted("carla_pandar_qt", {0, 48, -90}, {0.25, -0.85, -0.595})},
                 {"right", mounted("carla_pandar_qt", {0, 48, 90}, {0.25, 0.85, -0.595})},
                 {"top", mounted("carla_pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

/// The real car of the paper's samples: a roof rack with a Pandar64 and two PandarQTs. The poses
/// are the nominal poses of the samples.
Rig croon_three() {
  Rig rig;
  rig.body = {4.7, 1.85, 1.5, true};
  rig.reference_height_m = 2.05;
  rig.reference_forward_m = -0.2;
  rig.sensors = {{"left", mounted("pandar_qt", {-4.2, 45.1, 92.0}, {0.0, 0.56, -0.39})},
                 {"right", mounted("pandar_qt", {-0.5, 45.8, -86.3}, {-0.04, -0.57, -0.41})},
                 {"top", mounted("pandar64", {0, 0, 0}, {0, 0, 0})}};
  return rig;
}

/// A sensor in the frame of the car.
struct OnCar {
  std::string name;
  SensorModel model;
  std::vector<double> rpy_deg;
  std::vector<double> position_m;
};

/// `values` to six decimals: poses are computed, and the same on all machines.
std::vector<double> rounded(const Eigen::Vector3d& values) {
  std::vector<double> result;
  for (const double value : values) result.push_back(std::round(value * 1e6) / 1e6 + 0.0);
  return result;
}

/// The rig of sensors given in the frame of the car.
Rig rig_on_car(const CarBody& body, const std::string& reference,
               const std::vector<OnCar>& sensors) {
  Rig rig;
  rig.body = body;
  rig.reference = reference;
  for (const OnCar& sensor : sensors) {
    if (sensor.name != reference) continue;
    rig.reference_rpy_deg = sensor.rpy_deg;
    rig.reference_forward_m = sensor.position_m[0];
    rig.reference_left_m = sensor.position_m[1];
    rig.reference_height_m = sensor.position_m[2];
  }
  const RigidTransform T_reference_car = rig.T_car_reference().inverse();
  for (const OnCar& sensor : sensors) {
    Mounting mounting;
    mounting.model = sensor.model;
    if (sensor.name != reference) {
      const RigidTransform T = T_reference_car * pose_of(sensor.rpy_deg, sensor.position_m);
      mounting.rotation_rpy_deg = rounded(exact_rpy(T.rotation) * deg_from_rad(1.0));
      mounting.translation_m = rounded(T.translation);
    }
    rig.sensors.emplace_back(sensor.name, mounting);
  }
  return rig;
}

/// The sensor `name` with another range of azimuths.
SensorModel with_azimuths(const char* name, double from_deg, double to_deg) {
  SensorModel model = sensor_model(name);
  model.azimuth_from_deg = from_deg;
  model.azimuth_to_deg = to_deg;
  return model;
}

/// Four solid-state sensors of 120 degrees in the middles of the roof's edges.
Rig van_ring_four() {
  const SensorModel model = sensor_model("solid_state");
  return rig_on_car({6.0, 2.0, 2.6, true, HullShape::van}, "front",
                    {{"back", model, {0, 8, 180}, {-2.95, 0, 2.7}},
                     {"front", model, {0, 0, 0}, {1.75, 0, 2.7}},
                     {"left", model, {0, 8, 90}, {0, 1.0, 2.7}},
                     {"right", model, {0, 8, -90}, {0, -1.0, 2.7}}});
}

/// Six solid-state sensors of 80 degrees around the body, at bumpers and flanks.
Rig van_ring_six() {
  const SensorModel model = with_azimuths("solid_state", -40.0, 40.0);
  return rig_on_car({6.0, 2.0, 2.6, true, HullShape::van}, "front",
                    {{"back", model, {0, 2, 180}, {-3.1, 0, 0.9}},
                     {"front", model, {0, 0, 0}, {3.1, 0, 0.8}},
                     {"front_left", model, {0, 4, 60}, {1.2, 1.08, 1.3}},
                     {"front_right", model, {0, 4, -60}, {1.2, -1.08, 1.3}},
                     {"rear_left", model, {0, 4, 120}, {-1.2, 1.08, 1.3}},
                     {"rear_right", model, {0, 4, -120}, {-1.2, -1.08, 1.3}}});
}

/// A stiff articulated lorry: two sensors on the front corners of the tractor's roof, two at the
/// flanks of the trailer, and one at its rear.
Rig tractor_trailer() {
  const SensorModel model = sensor_model("solid_state");
  return rig_on_car({16.5, 2.5, 3.9, true, HullShape::truck}, "front_left",
                    {{"front_left", model, {0, 8, 50}, {7.65, 1.2, 3.35}},
                     {"front_right", model, {0, 8, -50}, {7.65, -1.2, 3.35}},
                     {"rear", model, {0, 6, 180}, {-8.35, 0, 2.2}},
                     {"side_left", model, {0, 6, 115}, {2.0, 1.4, 2.4}},
                     {"side_right", model, {0, 6, -115}, {2.0, -1.4, 2.4}}});
}

/// A small robot: two sensors of 270 degrees at opposite corners, and one of 70 degrees on a mast,
/// which looks into the blind quadrant of the reference.
Rig robot_two() {
  SensorModel corner = with_azimuths("spinner_32", -135.0, 135.0);
  corner.min_range_m = 0.05;
  corner.max_range_m = 60.0;
  SensorModel mast = with_azimuths("solid_state", -35.0, 35.0);
  mast.min_range_m = 0.2;
  mast.max_range_m = 60.0;
  return rig_on_car({0.9, 0.6, 0.55, true, HullShape::box}, "rear",
                    {{"front", corner, {0, 0, 45}, {0.49, 0.34, 0.45}},
                     {"mast", mast, {0, 10, 45}, {0, 0, 0.9}},
                     {"rear", corner, {0, 0, -135}, {-0.49, -0.34, 0.45}}});
}

/// Two spinning sensors on the roof, tilted outwards by 25 degrees, and one low at the rear, which
/// sees only what the left one sees; the right one is the reference.
Rig roof_two() {
  return rig_on_car(
      {}, "right",
      {{"left", sensor_model("spinner_16"), {-25, 0, 0}, {-0.3, 0.55, 1.75}},
       {"rear", with_azimuths("solid_state", -40.0, 40.0), {0, 14, 100}, {-2.3, 0.75, 0.55}},
       {"right", sensor_model("spinner_16"), {25, 0, 0}, {-0.3, -0.55, 1.75}}});
}

/// Three rosette heads in one housing on the roof, 30 degrees apart: each shares 8 degrees with its
/// neighbour.
Rig livox_three() {
  const SensorModel model = sensor_model("rosette_38");
  return rig_on_car({}, "left",
                    {{"left", model, {0, 0, 30}, {0, 0.06, 1.58}},
                     {"middle", model, {0, 0, 0}, {0, 0, 1.58}},
                     {"right", model, {0, 0, -30}, {0, -0.06, 1.58}}});
}

using Silhouette = std::vector<std::array<double, 2>>;

/// The silhouette from the tail over the roof to the nose (x and z relative to the length and
/// height); all of it is visible from the middle of the body. That of a car is measured from the
/// points that the sensors of the paper's samples see on theirs.
const Silhouette& silhouette_of(HullShape shape) {
  static const Silhouette car = {
      {-0.47, 0.18}, {-0.48, 0.40}, {-0.45, 0.64}, {-0.40, 0.75}, {-0.28, 0.90}, {-0.15, 0.97},
      {-0.09, 1.00}, {-0.02, 0.99}, {0.04, 0.96},  {0.12, 0.88},  {0.205, 0.79}, {0.29, 0.66},
      {0.374, 0.59}, {0.42, 0.51},  {0.45, 0.44},  {0.47, 0.36},  {0.475, 0.28}, {0.47, 0.18}};
  static const Silhouette van = {{-0.49, 0.15}, {-0.5, 0.4}, {-0.49, 0.95}, {-0.47, 1.0},
                                 {0.25, 1.0},   {0.3, 0.97}, {0.4, 0.6},    {0.47, 0.52},
                                 {0.49, 0.44},  {0.5, 0.25}, {0.49, 0.15}};
  static const Silhouette truck = {{-0.5, 0.25}, {-0.5, 1.0},  {0.34, 1.0}, {0.34, 0.82},
                                   {0.47, 0.82}, {0.495, 0.6}, {0.5, 0.12}};
  static const Silhouette box = {{-0.5, 0.2}, {-0.5, 1.0}, {0.5, 1.0}, {0.5, 0.2}};
  switch (shape) {
    case HullShape::van:
      return van;
    case HullShape::truck:
      return truck;
    case HullShape::box:
      return box;
    default:
      return car;
  }
}

/// Half the width of the body at a relative length and height. A car is narrower from the windows
/// up to the roof, and towards nose and tail.
double half_width_m(const CarBody& body, double length_share, double height_share) {
  if (body.shape != HullShape::car) return 0.5 * body.width_m;
  const auto narrowed = [](double share, double from, double to, double min_share) {
    return 1.0 - (1.0 - min_share) * std::clamp((share - from) / (to - from), 0.0, 1.0);
  };
  return 0.5 * body.width_m * narrowed(height_share, 0.6, 1.0, 0.72) *
         narrowed(length_share, 0.36, 0.5, 0.56) * narrowed(-length_share, 0.40, 0.5, 0.72);
}

/// Adds the hull over the silhouette: one band across the car, and its two sides.
void add_hull(Mesh& mesh, const CarBody& body) {
  const Silhouette& silhouette = silhouette_of(body.shape);
  const auto corners = static_cast<std::uint32_t>(silhouette.size());
  std::array<std::uint32_t, 2> first{};
  std::array<std::uint32_t, 2> hub{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    first[side] = mesh.next_vertex();
    for (const auto& [x, z] : silhouette) {
      mesh.add_vertex({x * body.length_m, sign * half_width_m(body, x, z), z * body.height_m});
    }
    hub[side] = mesh.add_vertex({0.0, sign * half_width_m(body, 0.0, 0.5), 0.5 * body.height_m});
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t next = (i + 1) % corners;
    mesh.add_quad(first[0] + i, first[0] + next, first[1] + next, first[1] + i, Material::paint);
    for (std::size_t side = 0; side < 2; ++side) {
      mesh.add_triangle(hub[side], first[side] + i, first[side] + next, Material::paint);
    }
  }
}

void add_wheels(Mesh& mesh, const CarBody& body) {
  const bool is_car = body.shape == HullShape::car;
  const double radius_m = is_car ? 0.31 : std::min(0.17 * body.height_m, 0.5);
  const double width_m = is_car ? 0.2 : std::min(0.3 * body.width_m, 0.3);
  for (const double x : {-0.28 * body.length_m, 0.30 * body.length_m}) {
    for (const double side : {-1.0, 1.0}) {
      const double outside_m = side * (0.46 * body.width_m);
      add_cylinder(mesh, {x, outside_m, radius_m}, {x, outside_m - side * width_m, radius_m},
                   radius_m, radius_m, 14, Material::rubber);
    }
  }
}

}  // namespace

RigidTransform Mounting::T_reference_sensor() const {
  return pose_of(rotation_rpy_deg, translation_m);
}

RigidTransform Rig::T_car_reference() const {
  return pose_of(reference_rpy_deg, {reference_forward_m, reference_left_m, reference_height_m});
}

const std::vector<std::pair<std::string, Rig>>& rigs() {
  static const std::vector<std::pair<std::string, Rig>> rigs = {
      {"croon_five", croon_five()},
      {"croon_three", croon_three()},
      {"van_ring_four", van_ring_four()},
      {"van_ring_six", van_ring_six()},
      {"tractor_trailer", tractor_trailer()},
      {"robot_two", robot_two()},
      {"roof_two", roof_two()},
      {"livox_three", livox_three()}};
  return rigs;
}

Mesh make_own_car(const CarBody& body) {
  Mesh mesh;
  if (!body.is_visible) return mesh;
  add_hull(mesh, body);
  add_wheels(mesh, body);
  return mesh;
}

}  // namespace croon::simulation
