#pragma once

#include <memory>
#include <string>

#include "experiments/python/interpreter.hpp"

namespace croon::python {

/// The stage of the kind `kind` that calls the methods of the Python object `instance`, as a
/// pointer to the class of the kind. `is_rig_step` selects a step whose method is `adjust`. Null
/// for a kind without a Python class.
std::shared_ptr<const void> python_stage(const std::string& kind, bool is_rig_step,
                                         const ObjectRef& instance);

}  // namespace croon::python
