#include "framework/simulation/recipe.hpp"

#include <algorithm>
#include <limits>

#include "framework/params/choice.hpp"
#include "framework/params/group.hpp"

namespace croon::simulation {
namespace {

using params::boolean;
using params::integer;
using params::number;
using params::numbers;
using params::Preset;
using params::Table;

template <class Named>
std::vector<Preset<typename Named::value_type::second_type>> presets(const Named& named) {
  std::vector<Preset<typename Named::value_type::second_type>> result;
  for (const auto& [name, value] : named) result.push_back({name, value});
  return result;
}

Table<SensorModel> sensor_table() {
  Table<SensorModel> table = {
      numbers("elevations_deg", &SensorModel::elevations_deg, {-90.0, 90.0},
              "Elevations of the rings, ring 0 first."),
      number("azimuth_from_deg", &SensorModel::azimuth_from_deg, {-360.0, 360.0},
             "Azimuth of the first rays of a sweep, from x towards y."),
      number("azimuth_to_deg", &SensorModel::azimuth_to_deg, {-360.0, 360.0},
             "Azimuth before which the sweep ends."),
      number("azimuth_step_deg", &SensorModel::azimuth_step_deg, {0.01, 90.0},
             "Step between consecutive azimuths."),
      params::optional(
          integer("rosette_rays", &SensorModel::rosette_rays, {0, 1000000},
                  "Rays of a scan along a rosette about x, instead of rings and azimuths.")),
      params::optional(number("rosette_width_deg", &SensorModel::rosette_width_deg, {1.0, 170.0},
                              "Width of the field of view of a rosette; without it 38.4.")),
      params::optional(number("rosette_height_deg", &SensorModel::rosette_height_deg, {1.0, 170.0},
                              "Height of the field of view of a rosette; without it 38.4.")),
      number("min_range_m", &SensorModel::min_range_m, {0.0, 1000.0},
             "Minimum range; nearer surfaces are ignored and do not occlude others.")
          .formerly("range_min_m"),
      number("max_range_m", &SensorModel::max_range_m, {0.1, 1000.0}, "Maximum range.")
          .formerly("range_max_m"),
      number("period_s", &SensorModel::period_s, {0.001, 10.0}, "Duration of one sweep."),
  };
  table.require([](const SensorModel& s) { return s.azimuth_to_deg > s.azimuth_from_deg; },
                "azimuth_to_deg must be greater than azimuth_from_deg");
  table.require([](const SensorModel& s) { return s.azimuth_to_deg <= s.azimuth_from_deg + 360.0; },
                "azimuth_to_deg must be at most 360 more than azimuth_from_deg");
  table.require([](const SensorModel& s) { return s.max_range_m > s.min_range_m; },
                "max_range_m must be greater than min_range_m");
  table.require([](const SensorModel& s) { return s.elevations_deg.size() <= 1024; },
                "elevations_deg must have at most 1024 rings");
  return table;
}

Table<Mounting> mounting_table() {
  Table<Mounting> table = {
      params::group("model", &Mounting::model, sensor_table(), presets(sensor_models()),
                    "Model of the LiDAR."),
      numbers(
          "rotation_rpy_deg", &Mounting::rotation_rpy_deg, {-360.0, 360.0},
          "Roll, pitch and yaw of the sensor in the reference, R = Rz(yaw) Ry(pitch) Rx(roll)."),
      numbers("translation_m", &Mounting::translation_m, {-100.0, 100.0},
              "Position of the sensor in the reference's frame: x forward, y left, z up."),
      number("time_offset_s", &Mounting::time_offset_s, {-10.0, 10.0},
             "Delay of its sweep relative to the reference's; matters with sweep_distortion."),
  };
  table.require([](const Mounting& m) { return m.rotation_rpy_deg.size() == 3; },
                "rotation_rpy_deg must have three numbers");
  table.require([](const Mounting& m) { return m.translation_m.size() == 3; },
                "translation_m must have three numbers");
  return table;
}

Table<CarBody> body_table() {
  return {
      boolean("is_visible", &CarBody::is_visible, "Whether the sensors see the car's own body."),
      number("length_m", &CarBody::length_m, {0.5, 30.0}, "Length of the car."),
      number("width_m", &CarBody::width_m, {0.3, 5.0}, "Width of the car."),
      number("height_m", &CarBody::height_m, {0.3, 6.0}, "Height of the car."),
      params::optional(params::choice(
          "shape", &CarBody::shape,
          {{"car", HullShape::car},
           {"van", HullShape::van},
           {"truck", HullShape::truck},
           {"box", HullShape::box}},
          "Shape of its hull, without it that of a car; a `truck` is a tractor with a trailer.")),
  };
}

/// Whether the reference is one of the sensors, with a zero pose and a zero time_offset_s.
bool has_reference(const Rig& rig) {
  return std::any_of(rig.sensors.begin(), rig.sensors.end(), [&](const auto& sensor) {
    const RigidTransform T = sensor.second.T_reference_sensor();
    return sensor.first == rig.reference && sensor.second.time_offset_s == 0.0 &&
           T.rotation.isIdentity(0.0) && T.translation.isZero(0.0);
  });
}

Table<Rig> rig_table() {
  Table<Rig> table = {
      params::text("reference", &Rig::reference, "The sensor to which the others are calibrated."),
      number("reference_height_m", &Rig::reference_height_m, {0.1, 10.0},
             "Height of the reference above the road."),
      number("reference_forward_m", &Rig::reference_forward_m, {-15.0, 15.0},
             "Distance of the reference ahead of the middle of the car."),
      params::optional(number("reference_left_m", &Rig::reference_left_m, {-5.0, 5.0},
                              "Distance of the reference to the left of the middle of the car.")),
      params::optional(numbers(
          "reference_rpy_deg", &Rig::reference_rpy_deg, {-360.0, 360.0},
          "Roll, pitch and yaw of the reference on the car; without it the reference is level.")),
      params::group("body", &Rig::body, body_table(), {}, "The car that carries the sensors."),
      params::map("sensors", &Rig::sensors, mounting_table(), "a sensor's name",
                  "The sensors by name, including the reference."),
  };
  table.require([](const Rig& rig) { return rig.reference_rpy_deg.size() == 3; },
                "reference_rpy_deg must have three numbers");
  table.require(has_reference,
                "sensors must have the reference, with a pose and a time_offset_s of zeros");
  table.require([](const Rig& rig) { return rig.sensors.size() >= 2; },
                "sensors must have the reference and another");
  return table;
}

/// The table row for the weight of `kind`.
params::Parameter<Mix> weight_row(SceneKind kind) {
  params::ParameterDoc doc;
  doc.key = row_of(kind).name;
  doc.type = params::ParameterType::number;
  doc.default_json = params::value_json(0.0);
  doc.range = {0.0, 1e9};
  doc.sentence = row_of(kind).sentence;
  const auto index = static_cast<std::size_t>(kind);
  return params::value_row<Mix>(
      doc, [=](auto& mix) -> auto& { return mix.weights[index]; });
}

Table<Mix> mix_table() {
#define CROON_WEIGHT_ROW(name, weight, sentence) weight_row(SceneKind::name),
  Table<Mix> table = {CROON_SCENE_KINDS(CROON_WEIGHT_ROW)};
#undef CROON_WEIGHT_ROW
  table.require(
      [](const Mix& mix) {
        const auto is_positive = [](double weight) { return weight > 0.0; };
        return std::any_of(mix.weights.begin(), mix.weights.end(), is_positive);
      },
      "at least one weight must be positive");
  return table;
}

Table<Noise> noise_table() {
  return {
      number("range_std_m", &Noise::range_std_m, {0.0, 10.0}, "Standard deviation of a range."),
      number("angle_std_deg", &Noise::angle_std_deg, {0.0, 10.0},
             "Standard deviation of a ray's azimuth and of its elevation."),
      number("dropout_ratio", &Noise::dropout_ratio, {0.0, 1.0},
             "Share of the rays that are lost regardless of the surface."),
      number("detection_range_m", &Noise::detection_range_m, {0.0, 10000.0},
             "Range at which half of the rays return from a perpendicular target with 10 % "
             "reflectivity; 0: all rays return."),
      params::optional(number("footprint_deg", &Noise::footprint_deg, {0.0, 2.0},
                              "Diameter of a ray, which returns a range in between at an edge "
                              "between surfaces of similar range; without it a ray is a line.")),
      boolean("sweep_distortion", &Noise::moves_during_scan,
              "Whether the car and other objects move while the sensors sweep; otherwise a scan is "
              "instantaneous."),
      params::optional(number("clock_offset_s", &Noise::clock_offset_s, {-10.0, 10.0},
                              "Offset of the clocks of all sensors except the reference; their "
                              "times are too late by this.")),
  };
}

}  // namespace

const params::Table<Recipe>& recipe_table() {
  static const params::Table<Recipe> table = {
      params::group("rig", &Recipe::rig, rig_table(), presets(rigs()), "The car with its sensors."),
      params::group(
          "mix", &Recipe::mix, mix_table(), {{"paper", paper_mix()}},
          "Frequencies of the kinds of scenes, as weights; kinds that are not named do not occur."),
      params::group("noise", &Recipe::noise, noise_table(),
                    {{"none", Noise{}},
                     {"carla", carla_noise()},
                     {"real_still", real_still_noise()},
                     {"real", real_noise()},
                     {"mixed_pixels", mixed_pixels_noise()}},
                    "Measurement errors of the sensors."),
      params::optional(
          number("speed_mps", &Recipe::speed_mps, {0.0, 100.0},
                 "The speed of the car in all scenes; without it each scene has its own. The road "
                 "ahead is kept clear only for the scene's own speed: a faster car may drive "
                 "through objects ahead. Matters with sweep_distortion.")),
      params::optional(
          integer("scans_per_drive", &Recipe::scans_per_drive, {1, 1000},
                  "Number of consecutive scenes that are scans of one drive through the same "
                  "surroundings; without it each scene is a place of its own.")),
      params::optional(number("scan_interval_s", &Recipe::scan_interval_s, {0.001, 10.0},
                              "Time between two scans of a drive; without it 0.1.")),
      integer("seed", &Recipe::seed, {0, std::numeric_limits<int>::max()},
              "Seed of the scenes; the experiment's own seed affects only the initial guesses."),
  };
  return table;
}

}  // namespace croon::simulation
