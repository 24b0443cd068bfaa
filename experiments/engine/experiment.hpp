#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/params/slot.hpp"
#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::experiments {

/// The pose that starts are drawn around.
enum class StartCentre { truth, nominal, initial };

/// As many as a plan of several variants, scenes and sensors can hold.
inline constexpr int kMaxTrials = 1000000;

/// How starts are drawn: (R, t) moved to (R_d R, t + d), see DESIGN.md section 4.
struct StartRule {
  StartCentre around = StartCentre::truth;
  double rotation_deg = 45.0;  ///< Half range of each of R_d = Rz Ry Rx; 180 is uniform on SO(3).
  double translation_m = 0.1;  ///< Half range of each of d, in reference axes.
  int trials = 50;             ///< Per variant, scene and sensor.
};

/// How near the truth a trial must end to count as `success`.
struct SuccessBounds {
  double rotation_deg = 0.5;
  double translation_m = 0.1;
};

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
};

}  // namespace croon::experiments
