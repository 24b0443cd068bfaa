#include "framework/calibration/rig_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/threads.hpp"
#include "framework/calibration/close_ups.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

constexpr const char* kNominalState = "nominal";
constexpr const char* kResultState = "result";
constexpr float kNearSurface_m = 0.3F;
constexpr int kViewNeighbours = 10;

/// Maximum number of viewed points of a sensor.
constexpr int kMaxViewedPoints = 25000;

const CalibratedSensor& calibrated(const CalibratedRig& rig, const std::string& sensor) {
  return *std::find_if(rig.sensors.begin(), rig.sensors.end(),
                       [&](const CalibratedSensor& one) { return one.sensor == sensor; });
}

/// The names of the steps in the paths of all sensors, in the order of the pipeline.
std::vector<std::string> steps_of(const ShownScene& shown) {
  std::vector<std::string> steps;
  for (const ShownSensor& sensor : shown.sensors) {
    auto next = steps.begin();
    for (const StepPose& pose : sensor.path) {
      const auto found = std::find(steps.begin(), steps.end(), pose.step);
      next = (found == steps.end() ? steps.insert(next, pose.step) : found) + 1;
    }
  }
  return steps;
}

/// T_reference_sensor after the first `count` of `steps`.
std::optional<RigidTransform> pose_after(const ShownSensor& sensor,
                                         const std::vector<std::string>& steps, std::size_t count) {
  std::optional<RigidTransform> pose;
  for (std::size_t i = 0; i < count; ++i) {
    for (const StepPose& after : sensor.path) {
      if (after.step == steps[i]) pose = after.T_reference_sensor;
    }
  }
  return pose;
}

/// The poses of a sensor by state. Without `has_nominal`, no sensor has a nominal pose.
std::vector<std::optional<RigidTransform>> poses_of(const ShownSensor& sensor,
                                                    const CalibratedSensor& result,
                                                    const std::vector<std::string>& steps,
                                                    bool has_nominal) {
  std::vector<std::optional<RigidTransform>> poses;
  if (has_nominal) poses.push_back(result.nominal);
  for (std::size_t i = 1; i <= steps.size(); ++i) poses.push_back(pose_after(sensor, steps, i));
  poses.push_back(result.T_reference_sensor);
  return poses;
}

/// Removes the state of the last step if it equals the result of all sensors.
void merge_last_step(RigView& view) {
  if (view.states.size() < 2) return;
  const std::size_t last = view.states.size() - 1;
  for (const ViewedSensor& sensor : view.sensors) {
    if (sensor.poses[last] != sensor.poses[last - 1]) return;
  }
  view.states.erase(view.states.end() - 2);
  for (ViewedSensor& sensor : view.sensors) sensor.poses.pop_back();
}

/// The cloud of a viewed sensor.
using Clouds = std::vector<std::shared_ptr<const Cloud>>;

/// The surface of a cloud that is nearest to a point, both in the frame of the cloud.
struct NearSurface {
  float squared_distance_m2 = std::numeric_limits<float>::infinity();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f offset_m = Eigen::Vector3f::Zero();  ///< From the surface's point to the point.

  float along_normal_m() const { return normal.dot(offset_m); }
};

NearSurface near_surface(const Cloud& cloud, const Eigen::Vector3f& point) {
  const Neighbour nearest = cloud.kd_tree().nearest(point, kNearSurface_m);
  if (!nearest) return {};
  const Eigen::Vector3f normal = cloud.normals(kViewNeighbours).at(nearest.index).normal;
  if (normal.isZero()) return {};
  const auto index = static_cast<std::size_t>(nearest.index);
  return {nearest.squared_distance_m2, normal, point - cloud.points()[index]};
}

/// Calls `use(i, point, other, surface)` with each point i of the sensor `s` at `state` and the
/// surface of each other sensor near it, in the frame of the other sensor.
template <class Use>
void for_each_surface(const RigView& view, const Clouds& clouds, std::size_t s, std::size_t state,
                      const Use& use) {
  const ViewedSensor& sensor = view.sensors[s];
  for (std::size_t o = 0; o < view.sensors.size(); ++o) {
    const ViewedSensor& other = view.sensors[o];
    if (o == s || !(other.is_reference || other.is_accepted) || !other.poses[state]) continue;
    const RigidTransform T_other_sensor = other.poses[state]->inverse() * *sensor.poses[state];
    const Eigen::Matrix3f rotation = T_other_sensor.rotation.cast<float>();
    const Eigen::Vector3f translation = T_other_sensor.translation.cast<float>();
    for (std::size_t i = 0; i < sensor.points.size(); ++i) {
      const Eigen::Vector3f point = rotation * sensor.points[i] + translation;
      const NearSurface surface = near_surface(*clouds[o], point);
      if (std::isfinite(surface.squared_distance_m2)) use(i, o, rotation, surface);
    }
  }
}

/// The residual of `point` (in the frame of its sensor); the normal is in the same frame.
Residual residual_of(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                     float along_normal_m) {
  const float range_m = point.norm();
  float cosine = normal.dot(point) / std::max(range_m, 1e-3F);
  if (cosine < 0.0F) {
    cosine = -cosine;
    along_normal_m = -along_normal_m;
  }
  const double horizontal_m = std::hypot(point.x(), point.y());
  return {deg_from_rad(std::atan2(point.y(), point.x())),
          deg_from_rad(std::atan2(static_cast<double>(point.z()), horizontal_m)), range_m,
          deg_from_rad(std::acos(std::min(1.0, static_cast<double>(cosine)))), along_normal_m};
}

/// Distances to one other sensor's surfaces.
using PairDistances = std::vector<double>;

/// Sets the distances of sensor `s` at `state`, and its residuals if `is_last`; returns its
/// distances to each other sensor.
std::vector<PairDistances> set_distances(RigView& view, const Clouds& clouds, std::size_t s,
                                         std::size_t state, bool is_last) {
  ViewedSensor& sensor = view.sensors[s];
  std::vector<PairDistances> pairs(view.sensors.size());
  if (!sensor.poses[state]) return pairs;
  std::vector<NearSurface> nearest(sensor.points.size());
  std::vector<Eigen::Vector3f> normals(sensor.points.size());
  for_each_surface(view, clouds, s, state,
                   [&](std::size_t i, std::size_t other, const Eigen::Matrix3f& rotation,
                       const NearSurface& surface) {
                     pairs[other].push_back(std::abs(surface.along_normal_m()));
                     if (surface.squared_distance_m2 >= nearest[i].squared_distance_m2) return;
                     nearest[i] = surface;
                     normals[i] = rotation.transpose() * surface.normal;
                   });
  Distances& distances = sensor.distances[state];
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const bool is_any = std::isfinite(nearest[i].squared_distance_m2);
    distances.push_back(is_any ? std::abs(nearest[i].along_normal_m())
                               : std::numeric_limits<float>::quiet_NaN());
    if (is_any && is_last) {
      sensor.residuals.push_back(
          residual_of(sensor.points[i], normals[i], nearest[i].along_normal_m()));
    }
  }
  return pairs;
}

/// The agreement of each pair of sensors; `distances[a][b]` are those of the points of a.
std::vector<SensorAgreement> pair_agreements(
    const RigView& view, const std::vector<std::vector<PairDistances>>& distances) {
  std::vector<SensorAgreement> pairs;
  for (std::size_t a = 0; a < view.sensors.size(); ++a) {
    for (std::size_t b = a + 1; b < view.sensors.size(); ++b) {
      std::vector<double> both = distances[a][b];
      both.insert(both.end(), distances[b][a].begin(), distances[b][a].end());
      if (both.empty()) continue;
      const std::size_t of_a = distances[a][b].empty() ? 0 : view.sensors[a].points.size();
      const std::size_t of_b = distances[b][a].empty() ? 0 : view.sensors[b].points.size();
      pairs.push_back({view.sensors[a].sensor, view.sensors[b].sensor,
                       static_cast<double>(both.size()) / static_cast<double>(of_a + of_b),
                       median(both), both.size()});
    }
  }
  return pairs;
}

/// The view of a scene, with these refits of its sensors.
RigView view_with(const std::string& scene, const std::vector<std::string>& states,
                  const std::vector<ViewedCloud>& viewed,
                  const std::vector<std::optional<Refit>>& refits) {
  RigView view;
  view.scene = scene;
  view.states = states;
  view.level = level_frame(viewed.front().cloud->points());
  Clouds clouds;
  for (const ViewedCloud& one : viewed) {
    clouds.push_back(one.cloud);
    ViewedSensor& sensor = view.sensors.emplace_back();
    sensor.sensor = one.sensor;
    sensor.is_reference = view.sensors.size() == 1;
    sensor.is_accepted = one.is_accepted;
    sensor.refit = refits[view.sensors.size() - 1];
    sensor.points = evenly_spaced(one.cloud->points(), kMaxViewedPoints);
    for (const std::optional<RigidTransform>& pose : one.poses) {
      sensor.poses.push_back(pose ? std::optional(view.level.T_level_reference * *pose) : pose);
    }
    if (one.rival) sensor.rival = view.level.T_level_reference * *one.rival;
  }
  merge_last_step(view);
  const std::size_t last = view.states.size() - 1;
  std::vector<std::vector<PairDistances>> distances(view.sensors.size());
  for_each_in_parallel(view.sensors.size(), [&](std::size_t s) {
    if (last > 0) set_distances(view, clouds, s, 0, false);
    distances[s] = set_distances(view, clouds, s, last, true);
  });
  view.pairs = pair_agreements(view, distances);
  view.close_ups = close_ups(view);
  return view;
}

}  // namespace

RigView view_of(const std::string& scene, const std::vector<std::string>& states,
                const std::vector<ViewedCloud>& viewed) {
  std::vector<FittedCloud> fitted;
  for (const ViewedCloud& one : viewed) {
    fitted.push_back({one.cloud, one.poses.back(), one.is_accepted});
  }
  return view_with(scene, states, viewed, refits_of(fitted));
}

RigView rig_view(const CalibratedRig& rig) {
  const ShownScene& shown = rig.shown;
  if (!shown.reference) return {};
  const std::vector<std::string> steps = steps_of(shown);
  const bool has_nominal =
      std::any_of(rig.sensors.begin(), rig.sensors.end(),
                  [](const CalibratedSensor& sensor) { return sensor.nominal.has_value(); });
  std::vector<std::string> states;
  if (has_nominal) states.emplace_back(kNominalState);
  states.insert(states.end(), steps.begin(), steps.end());
  states.emplace_back(kResultState);
  std::vector<ViewedCloud> clouds = {
      {rig.reference, shown.reference, true, {states.size(), RigidTransform()}}};
  std::vector<std::optional<Refit>> refits = {std::nullopt};
  for (const ShownSensor& one : shown.sensors) {
    const CalibratedSensor& result = calibrated(rig, one.sensor);
    clouds.push_back({one.sensor, one.cloud, result.is_accepted,
                      poses_of(one, result, steps, has_nominal), one.rival});
    refits.push_back(result.refit);
  }
  return view_with(shown.scene, states, clouds, refits);
}

}  // namespace croon
