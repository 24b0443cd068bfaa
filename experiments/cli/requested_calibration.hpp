#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/recorded_scenes.hpp"
#include "framework/stage/catalogue.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the namespace of CLI11.
class App;
}

namespace croon::experiments {

/// The request for a calibration, from the command line or from a file (`rig.json`). Members that
/// were not given are empty.
struct RigRequest {
  std::vector<std::string> inputs;  ///< See recorded_scenes.
  std::string reference;            ///< Empty: the first sensor.
  std::string nominal;              ///< A file of extrinsics.
  bool from_scratch = false;        ///< Use the nominal poses for comparison only.
  bool at_rest = false;             ///< The vehicle is known to stand.
  std::optional<double> nominal_std_deg, nominal_std_m;
  std::string base;  ///< Pose of the reference in the vehicle frame, or a file.
  std::optional<double> max_time_gap_s;
  std::optional<int> max_scenes;
  std::string pipeline;
  std::optional<std::uint64_t> seed;
};

/// Reads a rig.json: an object with the keys of RigRequest. Relative paths in it are relative to
/// its folder. Throws InputError with every fault.
RigRequest read_rig_request(const std::filesystem::path& file);

/// The text of a rig.json in `folder` that requests the same calibration.
std::string rig_request_json(const RigRequest& request, const std::filesystem::path& folder);

struct CalibrateOptions : RigRequest {
  std::filesystem::path out = "results/calibration";
  std::vector<std::string> formats;  ///< In addition to csv and json.
  bool with_rejected = false;        ///< Write rejected poses too, marked as rejected.
  bool clouds = false;               ///< Write the clouds in the reference's frame.
  bool no_pictures = false;
  bool quiet = false;
  bool colours = false;
  int jobs = 0;  ///< 0: all cores.
};

// Shared by the commands that calibrate.

/// Adds their options.
void add_rig_options(CLI::App& command, CalibrateOptions& options);

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
