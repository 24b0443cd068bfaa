#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "experiments/cli/calibrate_command.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/recorded_scenes.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the namespace of CLI11.
class App;
}

namespace croon::experiments {

/// Adds the options of the commands that calibrate.
void add_rig_options(CLI::App& command, CalibrateOptions& options);

// Shared by the commands that calibrate.

/// The request, completed with the values of a rig.json among its inputs; the command line takes
/// precedence. Throws InputError if there are further inputs, or for a faulty file.
CalibrateOptions with_file(const CalibrateOptions& options);

/// The scenes of the inputs. Throws InputError, see recorded_scenes.
RecordedScenes scenes_of(const RigRequest& request);

/// Sets the nominal poses of the scans from the file `nominal`; does nothing if `nominal` is empty.
/// Returns a sentence for each sensor without a pose. Throws InputError if no sensor has one.
std::vector<std::string> set_nominal(std::vector<Scene>& scenes, const std::string& nominal);

/// Calibrates according to `options`; progress goes to `err`.
CalibratedRig calibrate_with_progress(const CalibrateOptions& options,
                                      const std::vector<Scene>& scenes, const Catalogue& catalogue,
                                      std::ostream& err);

}  // namespace croon::experiments
