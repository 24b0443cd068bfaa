#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "framework/pipeline/pipeline.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon {

// The library in three calls: read_point_cloud (framework/io/point_cloud_file.hpp), load_pipeline
// and calibrate.

/// The pipeline in the JSON `text`: a list of steps, or an object with such a list as "pipeline"
/// (e.g. an experiment; other keys are ignored). `file` is the name in errors. Throws InputError
/// with every fault.
Pipeline parse_pipeline(const std::string& text, const std::string& file,
                        const Catalogue& catalogue);

/// The same from parsed JSON; `faults` are those already found in it.
Pipeline pipeline_in(const nlohmann::json& document, const std::string& file,
                     const Catalogue& catalogue, std::vector<Fault> faults = {});

/// The same from the file `path`.
Pipeline load_pipeline(const std::filesystem::path& path, const Catalogue& catalogue);

/// The names of the random streams of a calibration. With the seed and the names of a trial,
/// `calibrate` computes the same bits as `croon run`.
struct CalibrationNames {
  std::uint64_t seed = 1;
  std::string scene = "scene";
  std::string reference = "reference";
  std::string sensor = "sensor";
  int trial = 0;
};

/// The random streams of computations that depend only on the cloud of `sensor`, and of a trial.
StreamKey cloud_stream(std::uint64_t seed, const std::string& scene, const std::string& sensor);
StreamKey trial_stream(const CalibrationNames& names);

/// Applies the steps of `pipeline` to `start`, a pose `T_target_source`. The result contains the
/// pose in `estimate.T_target_source`, or a `failure`.
PipelineResult calibrate(const Pipeline& pipeline, PointCloud target, PointCloud source,
                         const RigidTransform& start = {}, const CalibrationNames& names = {});

}  // namespace croon
