#include "framework/pipeline/calibrate.hpp"

#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "framework/params/json_file.hpp"
#include "framework/pipeline/patched_pipeline.hpp"

namespace croon {

Pipeline parse_pipeline(const std::string& text, const std::string& file,
                        const Catalogue& catalogue) {
  std::vector<Fault> faults;
  const nlohmann::json document = params::parse_json(text, file, faults);
  return pipeline_in(document, file, catalogue, std::move(faults));
}

Pipeline pipeline_in(const nlohmann::json& document, const std::string& file,
                     const Catalogue& catalogue, std::vector<Fault> faults) {
  const params::Node root(document, file, faults);
  const bool is_object = document.is_object() && document.contains("pipeline");
  const params::Node list = is_object ? root.member("pipeline") : root;
  if (!list.is_array()) throw InputError(std::move(faults));
  const PatchedPipeline steps = read_steps(list);
  Pipeline pipeline = build_pipeline(steps, catalogue, faults);
  if (faults.empty()) faults = unmet_needs(steps, pipeline);
  if (!faults.empty()) throw InputError(std::move(faults));
  return pipeline;
}

Pipeline load_pipeline(const std::filesystem::path& path, const Catalogue& catalogue) {
  return parse_pipeline(params::read_json_text(path), path.string(), catalogue);
}

StreamKey cloud_stream(std::uint64_t seed, const std::string& scene, const std::string& sensor) {
  return StreamKey(seed).with("cloud").with(scene).with(sensor);
}

StreamKey trial_stream(const CalibrationNames& names) {
  return StreamKey(names.seed)
      .with("trial")
      .with(names.scene)
      .with(names.sensor)
      .with(static_cast<std::uint64_t>(names.trial));
}

PipelineResult calibrate(const Pipeline& pipeline, PointCloud target, PointCloud source,
                         const RigidTransform& start, const CalibrationNames& names) {
  const auto cloud = [&](PointCloud points, const std::string& sensor) {
    return std::make_shared<const Cloud>(std::move(points),
                                         cloud_stream(names.seed, names.scene, sensor));
  };
  return run_pipeline(pipeline, cloud(std::move(target), names.reference),
                      cloud(std::move(source), names.sensor), start, trial_stream(names));
}

}  // namespace croon
