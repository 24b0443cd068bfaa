#include "framework/calibration/scan_fault_checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/registration/scan_faults.hpp"
#include "framework/stage/motion.hpp"

namespace croon {
namespace {

/// Fewer surfaces say nothing about faults.
constexpr double kMinSurfaces = 20.0;
/// A fault differs from zero by at least this number of standard deviations.
constexpr double kMinFaultDeviations = 5.0;

/// Maximum differences between the ranges of sound sensors. Estimates are up to half too
/// small, because some points touch surfaces that follow them, such as foliage.
constexpr double kMaxRangeScale = 0.002;
constexpr double kMaxRangeOffset_m = 0.04;

/// Maximum shift between the halves of a sound scan, in metres and standard deviations, and the
/// minimum ratio of robust costs.
constexpr double kMaxHalfShift_m = 0.08;
constexpr double kMaxHalfDeviations = 8.0;
constexpr double kMinCostRatio = 0.94;
/// Traffic that moves with the rig may look like a shifted half, so halves are tested at rest.
constexpr double kAtRest_mps = 0.1;

/// The difference between the ranges of a sensor and of the reference, by scale or by an offset.
struct RangeFault {
  std::size_t sensor = 0;
  bool is_scale = false;
  double size = 0.0;  ///< A ratio or metres.
};

/// The simpler description of a difference: the scale or the offset alone, whichever contradicts
/// the estimate of the other less. std::nullopt if it is within the bounds of sound sensors.
std::optional<RangeFault> range_fault(const RangeDifference& range) {
  const Eigen::Matrix2d& C = range.covariance;
  if (!(C(0, 0) > 0.0) || !(C(1, 1) > 0.0)) return std::nullopt;
  const bool is_scale =
      std::abs(range.offset_m) / std::sqrt(C(1, 1)) <= std::abs(range.scale) / std::sqrt(C(0, 0));
  const int own = is_scale ? 0 : 1, other = 1 - own;
  const Eigen::Vector2d estimate(range.scale, range.offset_m);
  // The estimate of one under the condition that the other is zero.
  const double size = estimate(own) - C(own, other) / C(other, other) * estimate(other);
  const double variance = C(own, own) - C(own, other) * C(own, other) / C(other, other);
  const double max_size = is_scale ? kMaxRangeScale : kMaxRangeOffset_m;
  if (std::abs(size) <= max_size) return std::nullopt;
  if (size * size <= kMinFaultDeviations * kMinFaultDeviations * variance) return std::nullopt;
  return RangeFault{0, is_scale, size};
}

/// "0.50 % longer than", for the ranges of a sensor relative to those of another.
std::string range_text(const RangeFault& fault, bool is_inverse) {
  const double size = std::abs(fault.size);
  return std::string("about ") +
         (fault.is_scale ? fixed_number(100.0 * size, 2) + " %" : fixed_number(size, 3) + " m") +
         ((fault.size > 0.0) != is_inverse ? " longer than" : " shorter than");
}

/// Whether all of `faults` are the same difference.
bool are_alike(const std::vector<RangeFault>& faults) {
  return std::all_of(faults.begin(), faults.end(), [&](const RangeFault& fault) {
    const double ratio = fault.size / faults.front().size;
    return fault.is_scale == faults.front().is_scale && ratio > 0.5 && ratio < 2.0;
  });
}

void reject(CalibratedSensor& sensor, const std::string& reason, const std::string& advice) {
  sensor.is_accepted = false;
  sensor.reasons.push_back(reason);
  sensor.advice.push_back(advice);
}

/// Rejects the sensors with `faults`, out of `compared` sensors.
void reject_ranges(CalibratedRig& rig, const std::vector<RangeFault>& faults,
                   std::size_t compared) {
  const bool is_reference = faults.size() > 1 && faults.size() == compared && are_alike(faults);
  for (const RangeFault& fault : faults) {
    CalibratedSensor& sensor = rig.sensors[fault.sensor];
    std::string reason, suspect;
    if (is_reference) {
      suspect = rig.reference;
      reason = "The ranges of " + rig.reference + " are " + range_text(fault, true) +
               " those of all other sensors, so no pose is right.";
    } else {
      // If several differ, or nothing else was compared, the reference may be wrong.
      const bool is_alone = faults.size() == 1 && compared > 1;
      suspect = is_alone ? sensor.sensor : rig.reference + " and " + sensor.sensor;
      reason = "The ranges of " + sensor.sensor + " are " + range_text(fault, false) +
               " those of " + rig.reference +
               (is_alone ? ", with which the other sensors agree" : "") + ", so no pose is right.";
    }
    reject(sensor, reason,
           "Check the range calibration and the driver of " + suspect +
               ", e.g. at a wall at a known distance.");
  }
}

/// Rejects a sensor if a half of its scans is shifted.
void reject_if_halves_differ(CalibratedSensor& sensor, const std::vector<HalfShift>& halves) {
  for (const HalfShift& half : halves) {
    const double squared = half.shift_m.dot(half.covariance.inverse() * half.shift_m);
    if (half.shift_m.norm() <= kMaxHalfShift_m || half.cost_ratio >= kMinCostRatio) continue;
    if (!(squared > kMaxHalfDeviations * kMaxHalfDeviations)) continue;
    const double begin_deg = deg_from_rad(half.azimuth_rad);
    reject(sensor,
           "The points of " + sensor.sensor + " at azimuths of " + fixed_number(begin_deg, 0) +
               " to " + fixed_number(begin_deg + 180.0, 0) + " degrees are shifted by " +
               fixed_number(half.shift_m.norm(), 2) +
               " m relative to the others, so no pose is "
               "right.",
           "Check whether the clouds are assembled from packets of one revolution, and whether "
           "motion was removed with the right velocity.");
    return;
  }
}

/// The accepted scans of a sensor.
std::vector<ComparedScan> scans_of(const CalibratedSensor& sensor,
                                   const std::vector<CalibrationMember>& members,
                                   const std::vector<MemberResult>& results) {
  std::vector<ComparedScan> scans;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].sensor != sensor.sensor || !results[i].is_accepted()) continue;
    const Estimate& estimate = results[i].estimate;
    scans.push_back({&*estimate.target, &*estimate.source, results[i].T_in_scene});
  }
  return scans;
}

/// Whether no accepted scan of the sensor was taken while the rig moved, as far as is known.
bool is_at_rest(const std::string& sensor, const std::vector<CalibrationMember>& members,
                const std::vector<MemberResult>& results) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].sensor != sensor || !results[i].is_accepted()) continue;
    const Twist* const velocity = results[i].estimate.extras.find(kMotion);
    if (velocity != nullptr && velocity->linear_mps.norm() > kAtRest_mps) return false;
  }
  return true;
}

}  // namespace

void reject_scan_faults(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
                        const std::vector<MemberResult>& results) {
  std::vector<RangeFault> faults;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < rig.sensors.size(); ++i) {
    CalibratedSensor& sensor = rig.sensors[i];
    if (!sensor.is_accepted) continue;
    const ScanFaults found = estimate_scan_faults(scans_of(sensor, members, results));
    if (found.surfaces < kMinSurfaces) continue;
    ++compared;
    if (std::optional<RangeFault> fault = range_fault(found.range)) {
      fault->sensor = i;
      faults.push_back(*fault);
    } else if (is_at_rest(sensor.sensor, members, results)) {
      reject_if_halves_differ(sensor, found.halves);
    }
  }
  reject_ranges(rig, faults, compared);
}

}  // namespace croon
