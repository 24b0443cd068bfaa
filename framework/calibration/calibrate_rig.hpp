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
  /// "best" (corrects motion if the times of all clouds permit, else looks for motion that was not
  /// corrected), "driving" or "paper"; or the file of a pipeline.
  std::string pipeline = "best";
  /// The JSON text of a pipeline, which messages call `pipeline`; if empty, that name counts.
  std::string pipeline_text = {};
  /// Compare with the nominal poses, but do not start from them.
  bool from_scratch = false;
  std::uint64_t seed = 1;
  int jobs = 0;  ///< Threads; 0: all cores.
  /// Called with what is being worked on, and the share of the work that is done, 0 to 1.
  std::function<void(const std::string& what, double done)> on_progress = {};
};

/// Calibrates the sensors of `scenes` to their common reference: one pose per sensor from all
/// scenes. Initial guesses are not needed; SensorScan::nominal is used if it is there. A cloud that
/// cannot be read or a scene that the pipeline cannot use is listed in CalibratedRig::unused.
/// The same bits for any number of threads. Throws InputError if no scene has two usable clouds,
/// or if the pipeline is unknown.
CalibratedRig calibrate_rig(const std::vector<Scene>& scenes, const CalibrationOptions& options,
                            const Catalogue& catalogue);

/// The names of the recommended pipelines, and the JSON text of one. Throws InputError, with the
/// nearest name, for an unknown name.
std::vector<std::string> recommended_pipeline_names();
const std::string& recommended_pipeline_text(const std::string& name);

}  // namespace croon
