#pragma once

#include <pybind11/pybind11.h>

#include "experiments/python/interpreter.hpp"
#include "framework/stage/step.hpp"

namespace croon::python {

/// A random stream for Python: a copy, so that it may outlive the call that received it.
struct PythonRng {
  Rng rng;
};

/// Converts `result`, returned by a Python step for `given`: an estimate, or a pose for `given`.
/// Throws InputError for anything else.
Estimate estimate_from(const py::object& result, Estimate given);

/// The C++ type of an extra from Python, for `float` or for any other object.
std::string extra_type(bool is_number);

/// The observability of each degree of freedom by its name, a dict; None without a covariance.
py::object words_from(const std::optional<PoseCovariance>& covariance);

}  // namespace croon::python
