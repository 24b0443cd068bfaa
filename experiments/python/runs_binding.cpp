// Runs of experiments, and folders of results.
#include <iostream>

#include "experiments/file/start_rule.hpp"
#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/interpreter.hpp"
#include "experiments/python/interruptible.hpp"
#include "experiments/python/result_arrays.hpp"
#include "experiments/python/stage_catalogue.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/session/run_in_folder.hpp"
#include "framework/base/threads.hpp"

namespace croon::python {
namespace {

using namespace experiments;  // NOLINT(google-build-using-namespace): used throughout.

/// Runs an experiment. Returns the folder and the complaints.
py::tuple run(const RunRequest& request, const FolderRun& requested) {
  const std::shared_ptr<const Catalogue> stages = catalogue();
  std::string folder;
  std::vector<std::string> complaints;
  std::vector<Fault> notes;
  interruptible([&](const std::function<void()>& check) {
    CheckedRun run = check_run(request, *stages);
    notes = run.experiment.notes;
    StoreHeader header = header_of(run);
    FolderRun how = requested;
    how.check = check;
    check();
    const OutputFolder output(run.out);
    complaints = run_in_folder(run, std::move(header), output, how, std::cerr).complaints;
    folder = run.out.string();
  });
  warn(notes);
  py::list lines;
  for (const std::string& complaint : complaints) lines.append(complaint);
  return py::make_tuple(folder, lines);
}

RunRequest request_from(const py::dict& options) {
  RunRequest request;
  request.experiment = text_of(options["experiment"]);
  if (!options["text"].is_none()) request.text = text_of(options["text"]);
  request.out = text_of(options["out"]);
  request.data = text_of(options["data"]);
  request.jobs = py::cast<int>(options["jobs"]);
  request.trials = py::cast<int>(options["trials"]);
  for (const py::handle variant : options["only"]) request.only.push_back(py::str(variant));
  request.shard = py::str(options["shard"]);
  return request;
}

py::tuple run_from(const py::dict& options) {
  FolderRun how;
  how.fresh = py::cast<bool>(options["fresh"]);
  how.same_build = py::cast<bool>(options["same_build"]);
  how.progress = progress_style_of_stderr(!py::cast<bool>(options["progress"]));
  return run(request_from(options), how);
}

/// The starts of an experiment: tuples (scene, sensor, trial, pose).
py::list starts(const py::dict& options) {
  const std::shared_ptr<const Catalogue> stages = catalogue();
  const RunRequest request = request_from(options);
  std::vector<std::tuple<std::string, std::string, int, RigidTransform>> starts;
  {
    const WithoutGil no_gil;
    const CheckedRun run = check_run(request, *stages);
    for (const SceneGroup& group : run.groups) {
      for (const CalibratedPair& pair : group.pairs) {
        for (int trial = 0; trial < total_trials(run.experiment.starts); ++trial) {
          starts.emplace_back(group.name, pair.name, trial,
                              start_of(run.experiment, group.name, pair, trial));
        }
      }
    }
  }
  py::list list;
  for (const auto& [scene, sensor, trial, pose] : starts) {
    list.append(py::make_tuple(scene, sensor, trial, array_from(pose)));
  }
  return list;
}

/// The rows passed by `rows` as a structured array.
template <class Rows>
py::object array_of(const Rows& rows) {
  ArrayOfRows array;
  std::vector<Column> columns;
  {
    const WithoutGil no_gil;
    columns = rows([&](const CellRow& row) { array.add(row); });
  }
  return array.array(columns);
}

/// The pose of each trial, N×4×4; NaN without a pose.
py::array poses(const Results& results) {
  const auto size = static_cast<py::ssize_t>(results.records.size());
  py::array_t<double> array({size, py::ssize_t{4}, py::ssize_t{4}});
  auto view = array.mutable_unchecked<3>();
  for (py::ssize_t n = 0; n < size; ++n) {
    const auto& pose = results.records[static_cast<std::size_t>(n)].T_reference_sensor;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Constant(std::nan(""));
    if (pose) {
      matrix.setIdentity();
      matrix.topLeftCorner<3, 3>() = pose->rotation;
      matrix.topRightCorner<3, 1>() = pose->translation;
    }
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) view(n, i, j) = matrix(i, j);
    }
  }
  return array;
}

std::unique_ptr<Results> load(const std::string& folder) {
  const WithoutGil no_gil;
  return std::make_unique<Results>(read_results(folder, Content::trials_and_steps));
}

}  // namespace

void bind_runs(py::module_& module) {
  using R = Results;
  py::class_<Results>(module, "Results")
      .def_readonly("name", &R::name)
      .def_readonly("description", &R::description)
      .def_readonly("seed", &R::seed)
      .def_readonly("planned", &R::planned)
      .def_readonly("manifest", &R::manifest)
      .def("trials",
           [](const R& r) {
             return array_of(
                 [&](const RowUse& use) { return trial_rows(r.records, r.summary, use); });
           })
      .def("summary",
           [](const R& r) {
             return array_of([&](const RowUse& use) { return summary_rows(r.summary, use); });
           })
      .def("comparisons",
           [](const R& r) {
             return array_of([&](const RowUse& use) { return comparison_rows(r.summary, use); });
           })
      .def("diagnostics",
           [](const R& r) {
             return array_of(
                 [&](const RowUse& use) { return diagnostic_rows(r.records, r.steps, use); });
           })
      .def("covariances",
           [](const R& r) {
             return array_of([&](const RowUse& use) { return covariance_rows(r.records, use); });
           })
      .def("poses", poses)
      .def("extrinsics", [](const R& r) { return extrinsics_json(r.summary, r.references); })
      .def("text", [](const R& r) { return result_text(r, false); });
  module.attr("MAX_JOBS") = kMaxJobs;
  module.attr("MAX_TRIALS") = kMaxTrials;
  module.def("run", run_from);
  module.def("load", load);
  module.def("starts", starts);
}

}  // namespace croon::python
