#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"
#include "framework/stage/dataset.hpp"

namespace croon {

/// How a rig is calibrated.
struct CalibrationOptions {
  /// "best", "paper", or the path of a pipeline file.
  std::string pipeline = "best";
  /// The JSON text of a pipeline, which messages refer to as `pipeline`; if empty, `pipeline`
  /// selects it.
  std::string pipeline_text = {};
  /// If true, nominal poses are compared with the result, but not used as initial guesses.
  bool from_scratch = false;
  /// Whether the vehicle is known to stand in all scenes: times are not used, and no motion is
  /// looked for. Throws InputError if the pipeline has no step time_check.
  bool at_rest = false;
  /// The standard deviations of the nominal poses: near them, three are searched.
  double nominal_std_deg = 10.0;
  double nominal_std_m = 1.0 / 3.0;
  std::uint64_t seed = 1;
  int jobs = 0;  ///< Number of threads; 0: all cores.
  /// Called with a description of the current work and the completed share of it, 0 to 1.
  std::function<void(const std::string& what, double done)> on_progress = {};
};

/// Calibrates the sensors of `scenes` to their common reference: one pose per sensor from all
/// scenes. Initial guesses are not required; SensorScan::nominal is used if present. Clouds that
/// cannot be read and scenes that the pipeline cannot use are listed in CalibratedRig::unused.
/// Bitwise the same result for any number of threads. Throws InputError if no scene has two usable
/// clouds, or if the pipeline is unknown.
CalibratedRig calibrate_rig(const std::vector<Scene>& scenes, const CalibrationOptions& options,
                            const Catalogue& catalogue);

/// The names of the recommended pipelines, and the JSON text of one. Throws InputError, with the
/// nearest name, for an unknown name.
std::vector<std::string> recommended_pipeline_names();
const std::string& recommended_pipeline_text(const std::string& name);

}  // namespace croon
