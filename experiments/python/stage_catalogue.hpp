#pragma once

#include <memory>

#include "experiments/python/interpreter.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::python {

/// The stages of croon and those that were registered in Python so far. What is built from it keeps
/// its stages, whatever is registered later. Thread-safe.
std::shared_ptr<const Catalogue> catalogue();

/// What a Python class says of the stage that it is; see the decorator croon.stage.
struct PythonStage {
  std::string kind;
  std::string name;
  std::string summary;
  std::string source;
  int version = 1;
  py::object type;      ///< The class.
  py::list parameters;  ///< Of croon._stages.Parameter.
  params::DataFlow flow;
  bool is_rig_step = false;  ///< A step whose method is `adjust`.
};

/// Adds the stage, or replaces an earlier one of the same class: the cell of a notebook may run
/// twice. Throws InputError if there is another stage of this kind and name, and for parameters
/// that are not right.
void register_stage(const PythonStage& stage);

}  // namespace croon::python
