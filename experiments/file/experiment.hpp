#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/file/expectation.hpp"
#include "experiments/file/start_rule.hpp"
#include "framework/params/slot.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// One pipeline of an experiment.
struct Variant {
  std::string name;  ///< "base" for the base pipeline.
  Pipeline pipeline;
  std::string resolved;  ///< Canonical JSON of the pipeline with all its parameters.
};

/// An experiment file, read, checked and with its variants and grid multiplied out.
struct Experiment {
  std::string file;
  std::string name;
  std::string description;  ///< The question it answers; may be empty.
  params::Slot<Dataset> dataset;
  StartRule starts;
  std::uint64_t seed = 1;
  SuccessBounds success;
  std::vector<Variant> variants;  ///< The base first, then in the order of the file.
  bool loops = false;             ///< Sensors are calibrated to each other too (scenes_of).
  Claims claims;                  ///< What the results are held against; decides no trial.
};

}  // namespace croon::experiments
