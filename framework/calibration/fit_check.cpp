#include "framework/calibration/fit_check.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/registration/icp_loop.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

/// The refit of cloud `s` to the surfaces of the others.
std::optional<Refit> refit_of(const std::vector<FittedCloud>& clouds, std::size_t s) {
  constexpr int kMaxFittedPoints = 25000, kNormalNeighbours = 10;
  const bool is_reference = s == 0;
  if (is_reference || !clouds[s].T_reference_sensor) return std::nullopt;
  Points others;
  for (std::size_t o = 0; o < clouds.size(); ++o) {
    const FittedCloud& other = clouds[o];
    if (o == s || !other.is_accepted || !other.T_reference_sensor) continue;
    const Points in_reference = transformed(other.cloud->points(), *other.T_reference_sensor);
    others.insert(others.end(), in_reference.begin(), in_reference.end());
  }
  const StreamKey key(1);
  const Cloud target(std::move(others), key);
  const Cloud source(evenly_spaced(clouds[s].cloud->points(), kMaxFittedPoints), key);
  IcpOptions options;
  options.max_distances_m = {0.3, 0.15};
  CorrespondenceRule rule;
  rule.target_normals = kNormalNeighbours;
  const RigidTransform& T = *clouds[s].T_reference_sensor;
  try {
    const Registration registration =
        iterate_icp(target, source, T, options, rule, point_to_plane_linearisation());
    const PoseError apart = pose_error(registration.T_target_source, T);
    const double squares = apart.dof.dot(registration.information * apart.dof);
    return Refit{apart.rotation_rad, apart.translation_m,
                 std::sqrt(std::max(0.0, squares) / registration.correspondences)};
  } catch (const StageError&) {
    return std::nullopt;  // Too few points correspond.
  }
}

}  // namespace

std::vector<std::optional<Refit>> refits_of(const std::vector<FittedCloud>& clouds) {
  std::vector<std::optional<Refit>> refits(clouds.size());
  for_each_in_parallel(clouds.size(), [&](std::size_t s) { refits[s] = refit_of(clouds, s); });
  return refits;
}

void set_refits(CalibratedRig& rig) {
  const ShownScene& shown = rig.shown;
  if (!shown.reference) return;
  std::vector<FittedCloud> clouds = {{shown.reference, RigidTransform(), true}};
  std::vector<CalibratedSensor*> sensors = {nullptr};
  for (const ShownSensor& one : shown.sensors) {
    CalibratedSensor& sensor =
        *std::find_if(rig.sensors.begin(), rig.sensors.end(),
                      [&](const CalibratedSensor& other) { return other.sensor == one.sensor; });
    clouds.push_back({one.cloud, sensor.T_reference_sensor, sensor.is_accepted});
    sensors.push_back(&sensor);
  }
  const std::vector<std::optional<Refit>> refits = refits_of(clouds);
  for (std::size_t s = 1; s < sensors.size(); ++s) sensors[s]->refit = refits[s];
}

bool is_contradicted(const std::optional<Refit>& refit) {
  return refit && refit->surface_shift_m > kMaxSurfaceShift_m;
}

bool is_doubtful(const CalibratedSensor& sensor) {
  return sensor.is_accepted && is_contradicted(sensor.refit);
}

std::string refit_text(const Refit& refit) {
  return "the surfaces fit better at a pose " + fixed_number(deg_from_rad(refit.rotation_rad), 2) +
         " deg and " + fixed_number(1e3 * refit.translation_m, 0) +
         " mm away, which moves them by " + fixed_number(1e3 * refit.surface_shift_m, 1) + " mm";
}

std::string fit_sentence(const std::optional<Refit>& refit) {
  if (!refit) return "";
  return is_contradicted(refit)
             ? "The clouds contradict this pose: " + refit_text(*refit) + "."
             : "Fit check: a new registration with all other sensors moves the surfaces by " +
                   fixed_number(1e3 * refit->surface_shift_m, 1) + " mm; up to " +
                   fixed_number(1e3 * kMaxSurfaceShift_m, 0) + " mm are usual.";
}

}  // namespace croon
