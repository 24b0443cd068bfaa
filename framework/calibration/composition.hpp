#pragma once

#include <map>
#include <set>
#include <string>

#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon {

/// The texts of the experiment files that the library contains, by name.
const std::map<std::string, std::string>& embedded_pipelines();

/// A pipeline as a calibration runs it. It always ends with a verdict and a covariance: those that
/// the file lacks are appended.
struct Composition {
  std::string name;       ///< "best"; a file's name.
  Pipeline from_nothing;  ///< For sensors without an initial guess.
  Pipeline near_nominal;  ///< The same steps, whose searches stay near the initial guess.
  std::set<std::string> target_channels;  ///< That a step needs of the reference's cloud.
  std::set<std::string> source_channels;  ///< That a step needs of the sensor's cloud.
};

/// The composition in the text of the embedded pipeline `name`. Throws std::logic_error for an
/// unknown name.
Composition embedded_composition(const std::string& name, const Catalogue& catalogue);

/// The composition "standing" for sensors whose clocks differ: their scans may be of different
/// moments, so a rig that moves at all is rejected.
Composition unsynchronised_composition(const Catalogue& catalogue);

/// The composition in the JSON `text` of a pipeline, called `name`. Throws InputError if it is
/// faulty.
Composition composition_in_text(const std::string& text, const std::string& name,
                                const Catalogue& catalogue);

/// The composition called `pipeline`, a recommended name or else a file. Throws InputError for
/// anything else, with the nearest name, and for a faulty file.
Composition composition_called(const std::string& pipeline, const Catalogue& catalogue);

}  // namespace croon
