#pragma once

#include <memory>

#include "experiments/python/interpreter.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::python {

/// The stages of croon and those registered in Python so far. Pipelines built from it keep their
/// stages, regardless of later registrations. Thread-safe.
std::shared_ptr<const Catalogue> catalogue();

/// The properties of a Python class as a stage; see the decorator croon.stage.
struct PythonStage {
  std::string kind;
  std::string name;
  std::string summary;
  std::string source;
  int version = 1;
  py::object type;      ///< The class.
  py::list parameters;  ///< A list of croon._stages.Parameter.
  params::DataFlow flow;
  bool is_rig_step = false;  ///< Whether it is a step with the method `adjust`.
};

/// Adds the stage, or replaces an earlier one of the same class, because a notebook cell may run
/// twice. Throws InputError if there is another stage of this kind and name, and for invalid
/// parameters.
void register_stage(const PythonStage& stage);

}  // namespace croon::python
