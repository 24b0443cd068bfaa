#include "experiments/engine/starts.hpp"

#include <cmath>
#include <map>

#include "experiments/engine/experiment_loader.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {
namespace {

/// Shoemake 1992: three uniform draws to a unit quaternion, uniform on S^3.
Eigen::Matrix3d uniform_rotation(Rng& rng) {
  const double u1 = rng.uniform();
  const double angle2 = 2.0 * kPi * rng.uniform();
  const double angle3 = 2.0 * kPi * rng.uniform();
  const double r1 = std::sqrt(1.0 - u1), r2 = std::sqrt(u1);
  const Eigen::Quaterniond q(r2 * std::cos(angle3), r1 * std::sin(angle2), r1 * std::cos(angle2),
                             r2 * std::sin(angle3));
  return q.toRotationMatrix();
}

/// The other centres that `scan` has, for the user to choose from.
std::string centres_of(const SensorScan& scan) {
  std::string known;
  for (const StartCentre centre :
       {StartCentre::truth, StartCentre::nominal, StartCentre::initial}) {
    if (!centre_pose(centre, scan)) continue;
    known += (known.empty() ? "" : ", ") + ("\"" + std::string(centre_name(centre)) + "\"");
  }
  return known.empty() ? "it has no pose to draw starts around" : "it has " + known;
}

/// The scenes in which one sensor lacks its pose.
struct Lack {
  std::vector<std::string> scenes;
  std::string instead;
};

std::string scene_list(const std::vector<std::string>& scenes) {
  constexpr std::size_t kShown = 3;
  std::string text = scenes.size() == 1 ? "scene " : "scenes ";
  for (std::size_t i = 0; i < scenes.size() && i < kShown; ++i) {
    text += (i == 0 ? "" : ", ") + scenes[i];
  }
  if (scenes.size() > kShown) text += " and " + std::to_string(scenes.size() - kShown) + " more";
  return text;
}

}  // namespace

const std::optional<RigidTransform>& centre_pose(StartCentre around, const SensorScan& scan) {
  if (around == StartCentre::nominal) return scan.nominal;
  if (around == StartCentre::initial) return scan.initial;
  return scan.truth;
}

RigidTransform draw_start(const StartRule& rule, const RigidTransform& centre, std::uint64_t seed,
                          const std::string& scene, const std::string& sensor, int trial) {
  Rng rng(StreamKey(seed).with("start").with(scene).with(sensor).with(
      static_cast<std::uint64_t>(trial)));
  const bool is_any_rotation = rule.rotation_deg == 180.0;
  const double range_rad = rad_from_deg(rule.rotation_deg);
  RigidTransform rotated = centre;
  Vector6d offset = Vector6d::Zero();
  if (is_any_rotation) {
    rotated.rotation = uniform_rotation(rng) * centre.rotation;
  } else {
    for (int i = 0; i < 3; ++i) offset(i) = rng.uniform(-range_rad, range_rad);
  }
  for (int i = 3; i < 6; ++i) offset(i) = rng.uniform(-rule.translation_m, rule.translation_m);
  return moved(rotated, offset);
}

void check_centres(const Experiment& experiment, const std::vector<Scene>& scenes) {
  const StartCentre around = experiment.starts.around;
  std::map<std::string, Lack> lacks;
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      if (centre_pose(around, scan)) continue;
      lacks[scan.sensor].scenes.push_back(scene.name);
      lacks[scan.sensor].instead = centres_of(scan);
    }
  }
  std::vector<Fault> faults;
  for (const auto& [sensor, lack] : lacks) {
    faults.push_back({experiment.file, "/starts/around",
                      "sensor \"" + sensor + "\" has no " + centre_name(around) +
                          " pose to draw starts around in " + scene_list(lack.scenes) + "; " +
                          lack.instead});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace croon::experiments
