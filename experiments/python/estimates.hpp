#pragma once

#include <pybind11/pybind11.h>

#include "experiments/python/interpreter.hpp"
#include "framework/stage/step.hpp"

namespace croon::python {

/// A random stream as Python has it: a copy, so that it may outlive the call that it came with.
struct PythonRng {
  Rng rng;
};

/// What a step of Python returned, `result` for `given`: an estimate, or a pose for it. Throws
/// InputError for anything else.
Estimate estimate_from(const py::object& result, Estimate given);

/// The type of an extra of Python in C++, for `float` and for any other object.
std::string extra_type(bool is_number);

/// The words of a covariance by the names of the degrees of freedom, a dict; None if there is none.
py::object words_from(const std::optional<PoseCovariance>& covariance);

}  // namespace croon::python
