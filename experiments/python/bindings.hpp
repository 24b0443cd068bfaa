#pragma once

#include <pybind11/pybind11.h>

namespace croon::python {

// The parts of the module, one per file.

void bind_errors();
void bind_clouds(pybind11::module_& module);
void bind_estimates(pybind11::module_& module);
void bind_rng(pybind11::module_& module);
void bind_stages(pybind11::module_& module);
void bind_pipelines(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_datasets(pybind11::module_& module);
void bind_calibration(pybind11::module_& module);

}  // namespace croon::python
