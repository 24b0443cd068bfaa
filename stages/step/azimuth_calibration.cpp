#include <map>
#include <numeric>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/params/group.hpp"
#include "framework/registration/azimuth_error.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

constexpr const char* kWithoutError = "without_azimuth_error";

/// An azimuth error in degrees, as users specify it.
struct KnownError {
  double offset_deg = 0.0;
  double sine_deg = 0.0;
  double cosine_deg = 0.0;
  double slope = 0.0;

  AzimuthError error() const {
    return {rad_from_deg(offset_deg), rad_from_deg(sine_deg), rad_from_deg(cosine_deg), slope};
  }
  /// Identifies the error in a cache.
  std::string key() const {
    return params::value_json(std::vector<double>{offset_deg, sine_deg, cosine_deg, slope});
  }
};

const params::Table<KnownError>& known_table() {
  static const params::Table<KnownError> table = {
      params::number("offset_deg", &KnownError::offset_deg, {-180.0, 180.0},
                     "Constant part of the error."),
      params::number("sine_deg", &KnownError::sine_deg, {-90.0, 90.0},
                     "Part proportional to the sine of the azimuth."),
      params::number("cosine_deg", &KnownError::cosine_deg, {-90.0, 90.0},
                     "Part proportional to its cosine."),
      params::number("slope", &KnownError::slope, {-10.0, 10.0},
                     "Part proportional to the elevation, in degrees per degree."),
  };
  return table;
}

struct Params : AzimuthOptions {
  std::vector<std::pair<std::string, KnownError>> known;
  bool estimate = true;
  double min_significance = 4.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::optional(
              params::map("known", &Params::known, known_table(), "a sensor's name",
                          "Known errors by sensor, which may include the reference: their clouds "
                          "are corrected and their errors are not estimated.")),
          params::boolean("estimate", &Params::estimate,
                          "Whether the errors of the other sensors are estimated; otherwise they "
                          "are assumed to be zero."),
          params::number("min_significance", &Params::min_significance, {0.0, 1e6},
                         "Minimum distance of an estimated error from zero, in standard "
                         "deviations, for the error and the pose to be corrected."),
      }
          .inherit(azimuth_table());
  return table;
}

class AzimuthCalibrationStep final : public RigStep {
 public:
  explicit AzimuthCalibrationStep(const Params& params)
      : params_(params), known_(params.known.begin(), params.known.end()) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow;
    for (const auto& [sensor, error] : params.known) flow.named_sensors.insert(sensor);
    return flow;
  }

  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    // The error belongs to the sensor, but is estimated against the surfaces of one target.
    const auto unknown = [&](RigEstimate& member) -> std::optional<RigKey> {
      if (!member.estimate.rejection) require_usable_clouds(member.estimate);
      // For rejected poses too: all sensors of a scene share the reference's cloud.
      correct_known(member);
      if (member.estimate.rejection || known_.count(member.source) > 0) return std::nullopt;
      return RigKey{member.target, member.source};
    };
    const std::vector<RigGroup> sensors = rig_groups(rig, unknown);
    if (!params_.estimate) return;
    for_each_group(sensors, [&](const RigGroup& estimates) { calibrate(estimates); });
  }

 private:
  /// Corrects the clouds of both sensors if their errors are known.
  void correct_known(RigEstimate& member) const {
    Estimate& estimate = member.estimate;
    const auto of_target = known_.find(member.target);
    if (of_target != known_.end()) {
      estimate.take_clouds(corrected(*estimate.target, of_target->second), estimate.source);
      estimate.information.reset();
    }
    const auto of_source = known_.find(member.source);
    if (of_source == known_.end()) return;
    estimate.take_clouds(estimate.target, corrected(*estimate.source, of_source->second));
    estimate.information.reset();
  }

  /// The corrected cloud, computed once for all sensors and trials of the scene.
  static std::shared_ptr<const Cloud> corrected(const Cloud& cloud, const KnownError& known) {
    return cloud.once<Cloud>(kWithoutError, known.key(), [&] {
      return cloud.derived(without_error(cloud.with_channels(), known.error()), kWithoutError);
    });
  }

  void calibrate(const RigGroup& estimates) const {
    std::vector<AzimuthView> views;
    for (const RigEstimate* const member : estimates) {
      const Estimate& estimate = member->estimate;
      views.push_back({&*estimate.target, &*estimate.source, estimate.T_target_source});
    }
    const AzimuthCalibration found = calibrate_azimuth(views, params_);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const int correspondences = found.correspondences[v];
      if (correspondences < kMinAzimuthCorrespondences) {
        estimates[v]->failure = "only " + std::to_string(correspondences) + " points correspond";
        continue;
      }
      write_result(found, found.T_target_source[v], estimates[v]->estimate);
    }
  }

  void write_result(const AzimuthCalibration& found, const RigidTransform& T,
                    Estimate& estimate) const {
    const bool is_corrected = found.significance() >= params_.min_significance;
    if (is_corrected) {
      const Cloud& source = *estimate.source;
      estimate.take_clouds(estimate.target,
                           source.derived_in_trial(
                               without_error(source.with_channels(), found.error), kWithoutError));
      estimate.set_pose(T);
    }
    const int correspondences =
        std::accumulate(found.correspondences.begin(), found.correspondences.end(), 0);
    const Eigen::Vector3d stds = found.covariance.diagonal().cwiseSqrt();
    estimate.diagnostics = {{"azimuth_offset_deg", deg_from_rad(found.error.offset_rad)},
                            {"azimuth_sine_deg", deg_from_rad(found.error.sine_rad)},
                            {"azimuth_cosine_deg", deg_from_rad(found.error.cosine_rad)},
                            {"azimuth_slope", found.error.slope},
                            {"azimuth_sine_std_deg", deg_from_rad(stds.x())},
                            {"azimuth_cosine_std_deg", deg_from_rad(stds.y())},
                            {"azimuth_slope_std", stds.z()},
                            {"azimuth_significance", found.significance()},
                            {"corrected", is_corrected ? 1.0 : 0.0},
                            {"rmse_before_m", found.rmse_before_m},
                            {"rmse_m", found.rmse_m},
                            {"correspondences", static_cast<double>(correspondences)},
                            {"surfaces", found.surfaces},
                            {"iterations", static_cast<double>(found.iterations)},
                            {"converged", found.converged ? 1.0 : 0.0}};
  }

  Params params_;
  std::map<std::string, KnownError> known_;
};

}  // namespace

StageEntry azimuth_calibration() {
  return stage_entry<AzimuthCalibrationStep>(
      "azimuth_calibration",
      "Processes the whole rig: estimates each sensor's azimuth error, one smooth function for all "
      "scenes of a trial, and corrects its clouds; known errors are corrected directly. Rejected "
      "poses are ignored.",
      "Lichti, ISPRS J. 2007; Muhammad and Lacroix, IROS 2010", table(), 3);
}

}  // namespace croon::stages::step
