#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"

namespace croon {

// The fit check registers each calibrated sensor once more, to the surfaces of all other accepted
// sensors: a check of accepted poses that is independent of the verdict.

/// Surfaces shift by less than this between a right pose and its refit.
inline constexpr double kMaxSurfaceShift_m = 0.015;

/// A cloud and its pose.
struct FittedCloud {
  std::shared_ptr<const Cloud> cloud;
  std::optional<RigidTransform> T_reference_sensor;
  bool is_accepted = false;
};

/// The refits of the clouds of one scene, the reference first. std::nullopt for the reference,
/// without a pose, and if too few points have a surface of another sensor within 0.3 m. Surfaces of
/// rejected sensors do not count. Same bits for any number of threads.
std::vector<std::optional<Refit>> refits_of(const std::vector<FittedCloud>& clouds);

/// Sets CalibratedSensor::refit of the sensors in `rig.shown`.
void set_refits(CalibratedRig& rig);

/// Whether a refit moves the surfaces of the sensor by more than `kMaxSurfaceShift_m`.
bool is_contradicted(const std::optional<Refit>& refit);

/// Whether the sensor is accepted and contradicted: its pose is not to be used unchecked.
bool is_doubtful(const CalibratedSensor& sensor);

/// "the surfaces fit better at a pose 0.30 deg and 50 mm away, which moves them by 31.2 mm".
std::string refit_text(const Refit& refit);

/// A sentence on the refit of a sensor, a warning if its clouds contradict the pose; empty without
/// a refit.
std::string fit_sentence(const std::optional<Refit>& refit);

}  // namespace croon
