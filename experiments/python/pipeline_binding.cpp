#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"
#include "experiments/python/interpreter.hpp"
#include "experiments/python/stage_catalogue.hpp"
#include "framework/pipeline/calibrate.hpp"

namespace croon::python {
namespace {

/// Raises croon.StageError. If the failure ends with the message of the recorded Python exception,
/// that exception is its cause.
[[noreturn]] void raise_failure(const std::string& failure, const CauseOfFailure& cause) {
  const py::object type = py::module_::import("croon._errors").attr("StageError");
  const py::object error = type(failure);
  const std::string& said = cause.message;
  const bool is_cause = cause.exception && failure.size() >= said.size() &&
                        failure.compare(failure.size() - said.size(), said.size(), said) == 0;
  if (is_cause) PyException_SetCause(error.ptr(), cause.exception.get().release().ptr());
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

py::dict steps_dict(const std::vector<StepRecord>& records) {
  py::dict steps;
  for (const StepRecord& record : records) {
    py::dict numbers;
    for (const auto& [name, value] : record.diagnostics) numbers[py::str(name)] = value;
    steps[py::str(record.name)] = numbers;
  }
  return steps;
}

py::dict seconds_dict(const std::vector<StepRecord>& records) {
  py::dict seconds;
  for (const StepRecord& record : records) seconds[py::str(record.name)] = record.seconds;
  return seconds;
}

/// A pipeline that threads may share, because running does not change it.
class SharedPipeline {
 public:
  explicit SharedPipeline(Pipeline pipeline) : pipeline_(std::move(pipeline)) {}

  /// pose, information, covariance, observability, diagnostics, rejection, seconds.
  py::tuple run(const py::object& target, const py::object& source, const py::object& initial,
                std::uint64_t seed, const std::string& scene, const std::string& reference,
                const std::string& sensor, int trial) const {
    PointCloud target_cloud = cloud_from(target, "target");
    PointCloud source_cloud = cloud_from(source, "source");
    const RigidTransform start =
        initial.is_none() ? RigidTransform() : pose_from(initial, "initial");
    PipelineResult result;
    CauseOfFailure cause;
    {
      const WithoutGil no_gil;
      result = calibrate(pipeline_, std::move(target_cloud), std::move(source_cloud), start,
                         {seed, scene, reference, sensor, trial});
    }
    if (!result.failure.empty()) raise_failure(result.failure, cause);
    const Estimate& estimate = result.estimate;
    return py::make_tuple(
        array_from(estimate.T_target_source), object_from(estimate.information),
        estimate.covariance ? py::object(array_from(estimate.covariance->matrix)) : py::none(),
        words_from(estimate.covariance), steps_dict(result.records),
        estimate.rejection ? py::object(py::str(*estimate.rejection)) : py::none(),
        seconds_dict(result.records));
  }

  py::list names() const {
    py::list names;
    for (const NamedStep& step : pipeline_) names.append(step.name);
    return names;
  }

  std::string resolved() const { return pipeline_json(pipeline_).dump(); }

 private:
  Pipeline pipeline_;
};

/// The pipeline that `read` returns, with a warning for each of its notes.
template <class Read>
std::unique_ptr<SharedPipeline> shared_pipeline(const Read& read) {
  const std::shared_ptr<const Catalogue> stages = catalogue();
  Pipeline pipeline;
  {
    const WithoutGil no_gil;
    pipeline = read(*stages);
  }
  std::vector<Fault> notes;
  add_notes(pipeline, notes);
  warn(notes);
  return std::make_unique<SharedPipeline>(std::move(pipeline));
}

std::unique_ptr<SharedPipeline> parsed(const std::string& text, const std::string& file) {
  return shared_pipeline(
      [&](const Catalogue& stages) { return parse_pipeline(text, file, stages); });
}

std::unique_ptr<SharedPipeline> loaded(const std::string& path) {
  return shared_pipeline([&](const Catalogue& stages) { return load_pipeline(path, stages); });
}

}  // namespace

void bind_pipelines(py::module_& module) {
  py::class_<SharedPipeline>(module, "Pipeline")
      .def("run", &SharedPipeline::run)
      .def("names", &SharedPipeline::names)
      .def("resolved", &SharedPipeline::resolved);
  module.def("parse_pipeline", parsed);
  module.def("load_pipeline", loaded);
}

}  // namespace croon::python
