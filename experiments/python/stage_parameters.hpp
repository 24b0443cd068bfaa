#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "experiments/python/interpreter.hpp"
#include "framework/params/table.hpp"

namespace croon::python {

/// The value of a parameter of a Python stage.
using ParameterValue = std::variant<bool, int, double, std::string, std::vector<double>>;

/// The parameters of a Python stage by key.
struct PythonParameters {
  std::map<std::string, ParameterValue> values;
};

/// The parameters of a stage as declared by croon.stage: their table, and their defaults.
struct DeclaredParameters {
  params::Table<PythonParameters> table;
  PythonParameters defaults;
};

/// Reads a list of croon._stages.Parameter. Throws InputError for a duplicate or invalid key, and
/// for a default outside its own range.
DeclaredParameters declared_parameters(const py::list& parameters, const std::string& stage);

/// The value as a Python object.
py::object object_of(const ParameterValue& value);

}  // namespace croon::python
