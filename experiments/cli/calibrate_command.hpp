#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The request for a calibration, from the command line or from a file (`rig.json`). Members that
/// were not given are empty.
struct RigRequest {
  std::vector<std::string> inputs;  ///< See recorded_scenes.
  std::string reference;            ///< Empty: the first sensor.
  std::string nominal;              ///< A file of extrinsics.
  bool from_scratch = false;        ///< Use the nominal poses for comparison only.
  std::string base;                 ///< Pose of the reference in the vehicle frame, or a file.
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

/// Calibrates the rig, prints the result and writes it to `options.out`; progress goes to `err`.
/// Returns 3 if a sensor is rejected. Throws InputError, before anything is written, if the request
/// is wrong.
int calibrate_command(const CalibrateOptions& options, const Catalogue& catalogue,
                      std::ostream& out, std::ostream& err);

}  // namespace croon::experiments
