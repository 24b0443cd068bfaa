#pragma once

#include <map>
#include <set>
#include <string>

#include "framework/geometry/pose_mean.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon {

/// The texts of the embedded experiment files, by name.
const std::map<std::string, std::string>& embedded_pipelines();

/// A pipeline as a calibration runs it. A verdict and a covariance are appended if the file lacks
/// them.
struct Composition {
  std::string name;                       ///< "best", or a file name.
  Pipeline from_nothing;                  ///< For sensors without an initial guess.
  Pipeline near_nominal;                  ///< The same steps, with searches near the initial guess.
  std::set<std::string> target_channels;  ///< Required of the reference's cloud.
  std::set<std::string> source_channels;  ///< Required of the sensor's cloud.
  std::set<std::string> channels;         ///< All that its steps read.
};

/// How a pipeline is adapted to a calibration.
struct CompositionOptions {
  /// The maximum distances from a nominal pose at which its sensor is searched for.
  PoseBounds nominal;
  bool at_rest = false;  ///< Whether the rig is known to stand: sets `at_rest` of steps.
};

/// The composition of the JSON `text` of a pipeline, named `name`. Throws InputError if it is
/// invalid.
Composition composition_in_text(const std::string& text, const std::string& name,
                                const CompositionOptions& options, const Catalogue& catalogue);

/// The composition `pipeline`, a recommended name or a file. Throws InputError for an unknown name,
/// with the nearest one, and for an invalid file.
Composition composition_called(const std::string& pipeline, const CompositionOptions& options,
                               const Catalogue& catalogue);

}  // namespace croon
