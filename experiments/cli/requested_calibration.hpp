#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "experiments/cli/calibrate_command.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/recorded_scenes.hpp"

namespace CLI {
class App;
}

namespace croon::experiments {

/// Adds the options of the commands that calibrate.
void add_rig_options(CLI::App& command, CalibrateOptions& options);

// What the commands that calibrate have in common.

/// The request with what a rig.json among its inputs says, if the command line says nothing else.
/// Throws InputError if there are further inputs, or for a faulty file.
CalibrateOptions with_file(const CalibrateOptions& options);

/// The scenes of the inputs. Throws InputError, see recorded_scenes.
RecordedScenes scenes_of(const RigRequest& request);

/// Gives the scans the poses in the file `nominal`; does nothing if that is empty. Returns a
/// sentence for each sensor without one. Throws InputError if no sensor has one.
std::vector<std::string> set_nominal(std::vector<Scene>& scenes, const std::string& nominal);

/// Calibrates as `options` ask, with progress on `err`.
CalibratedRig calibrate_with_progress(const CalibrateOptions& options,
                                      const std::vector<Scene>& scenes, const Catalogue& catalogue,
                                      std::ostream& err);

}  // namespace croon::experiments
