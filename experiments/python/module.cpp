// The module croon._core: the C++ parts used by croon/*.py. Users only see croon.
#include "experiments/python/bindings.hpp"
#include "experiments/python/interpreter.hpp"
#include "experiments/store/version.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace croon::python;
  bind_errors();
  bind_clouds(module);
  bind_estimates(module);
  bind_rng(module);
  bind_stages(module);
  bind_pipelines(module);
  bind_runs(module);
  bind_datasets(module);
  bind_calibration(module);
  module.attr("version") = croon::experiments::croon_version();
  py::module_::import("atexit").attr("register")(py::cpp_function(end_python));
}
