#include "experiments/python/stage_parameters.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "framework/params/group.hpp"

namespace croon::python {
namespace {

using params::Node;
using params::ParameterDoc;
using params::ParameterType;
using Row = params::Parameter<PythonParameters>;

/// The row of a parameter with values of type T.
template <class T>
Row row_of(ParameterDoc doc, const T& value) {
  doc.default_json = params::value_json(value);
  return params::value_row<PythonParameters>(
      doc, [key = doc.key](auto& parameters) -> auto& {
        return std::get<T>(parameters.values.at(key));
      });
}

/// The parameter types by their names in croon._stages.
const std::map<std::string, ParameterType>& types() {
  static const std::map<std::string, ParameterType> types = {
      {"boolean", ParameterType::boolean}, {"integer", ParameterType::integer},
      {"number", ParameterType::number},   {"text", ParameterType::text},
      {"choice", ParameterType::choice},   {"numbers", ParameterType::numbers}};
  return types;
}

double end_of(const py::object& end, double none) {
  return end.is_none() ? none : py::cast<double>(py::float_(end));
}

ParameterDoc doc_of(const py::handle& parameter) {
  ParameterDoc doc;
  doc.key = py::str(parameter.attr("key"));
  doc.type = types().at(py::str(parameter.attr("type")));
  doc.sentence = py::str(parameter.attr("help"));
  const double infinity = std::numeric_limits<double>::infinity();
  const py::tuple range = parameter.attr("range");
  doc.range = {end_of(range[0], -infinity), end_of(range[1], infinity)};
  for (const py::handle word : parameter.attr("choices")) doc.choices.push_back(py::str(word));
  return doc;
}

/// A value of the given type.
ParameterValue value_of_type(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return false;
    case ParameterType::integer:
      return 0;
    case ParameterType::number:
      return 0.0;
    case ParameterType::numbers:
      return std::vector<double>();
    default:
      return std::string();
  }
}

}  // namespace

DeclaredParameters declared_parameters(const py::list& parameters, const std::string& stage) {
  DeclaredParameters declared;
  std::vector<Fault> faults;
  for (const py::handle parameter : parameters) {
    const ParameterDoc doc = doc_of(parameter);
    ParameterValue value = value_of_type(doc.type);
    const std::string where = "the parameter \"" + doc.key + "\"";
    if (!params::kKeyName.allows(doc.key)) {
      faults.push_back({stage, where, "expected " + params::kKeyName.words});
    }
    if (declared.defaults.values.count(doc.key) > 0) {
      faults.push_back({stage, where, "expected each key once"});
    }
    // The default is parsed like a value in a file.
    const nlohmann::json json = nlohmann::json::parse(text_of(parameter.attr("json")));
    std::vector<Fault> of_default;
    std::visit(
        [&](auto& of_type) { params::read_value(Node(json, stage, of_default), doc, of_type); },
        value);
    for (const Fault& fault : of_default) {
      faults.push_back({stage, where, "its default: " + fault.message});
    }
    declared.table.add(
        std::visit([&](const auto& of_type) { return row_of(doc, of_type); }, value));
    declared.defaults.values[doc.key] = value;
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return declared;
}

py::object object_of(const ParameterValue& value) {
  return std::visit(
      [](const auto& of_type) -> py::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(of_type)>, std::vector<double>>) {
          py::list list;
          for (const double number : of_type) list.append(number);
          return py::tuple(list);
        } else {
          return py::cast(of_type);
        }
      },
      value);
}

}  // namespace croon::python
