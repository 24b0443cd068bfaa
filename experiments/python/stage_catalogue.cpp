#include "experiments/python/stage_catalogue.hpp"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"
#include "experiments/python/stage_adapters.hpp"
#include "experiments/python/stage_parameters.hpp"
#include "framework/params/group.hpp"
#include "registry/help.hpp"
#include "registry/registry.hpp"

namespace croon::python {
namespace {

/// The Python stages. Never destroyed, because it has objects of the interpreter, which ends first.
struct Stages {
  std::mutex mutex;
  std::vector<std::pair<StageEntry, std::string>> entries;  ///< With the names of their classes.
  std::shared_ptr<const Catalogue> all = std::make_shared<const Catalogue>(registry());
};

Stages& stages() {
  static auto* const stages = new Stages();
  return *stages;
}

/// An object of the class with the parameters as attributes. Notes a fault if construction fails.
ObjectRef instance_of(const ObjectRef& type, const PythonParameters& parameters,
                      const params::Node& node) {
  try {
    return in_python([&] {
      const py::object made = type.get().attr("__new__")(type.get());
      for (const auto& [key, value] : parameters.values) {
        py::setattr(made, key.c_str(), object_of(value));
      }
      made.attr("__init__")();
      return ObjectRef(made);
    });
  } catch (const StageError& error) {
    node.fault(std::string("the stage cannot be constructed: ") + error.what());
    return {};
  }
}

std::function<params::BuiltStage(const params::Node&, const params::StageBuilder&)> builder_of(
    const PythonStage& stage, const DeclaredParameters& declared) {
  return [is_rig_step = stage.is_rig_step, kind = stage.kind, name = stage.name, flow = stage.flow,
          type = ObjectRef(stage.type),
          declared](const params::Node& node, const params::StageBuilder& builder) {
    const PythonParameters parameters =
        declared.table.read(node, reserved_keys(kind), builder, declared.defaults);
    if (node.fault_count() > 0) return params::BuiltStage{};
    const ObjectRef instance = instance_of(type, parameters, node);
    if (!instance) return params::BuiltStage{};
    const params::Members first = {{name_key(kind), params::value_json(name)}};
    return params::BuiltStage{python_stage(kind, is_rig_step, instance),
                              name,
                              declared.table.json(parameters, first),
                              {},
                              flow};
  };
}

StageKind kind_called(const std::string& name) {
  for (const StageKind& kind : registry().kinds()) {
    if (kind.name == name) return kind;
  }
  throw InputError("", "kind", "unknown kind of stage \"" + name + "\"");
}

StageEntry entry_of(const PythonStage& stage) {
  const std::string path = stage.kind + "/" + stage.name;
  if (!params::kKeyName.allows(stage.name)) {
    throw InputError("", "name",
                     "expected " + params::kKeyName.words + ", found \"" + stage.name + "\"");
  }
  const StageKind kind = kind_called(stage.kind);
  const DeclaredParameters declared = declared_parameters(stage.parameters, path);
  return {kind.name,     stage.name, stage.summary,         stage.source,
          kind.summary,  kind.order, declared.table.docs(), builder_of(stage, declared),
          stage.version, stage.flow};
}

}  // namespace

std::shared_ptr<const Catalogue> catalogue() {
  const std::lock_guard<std::mutex> lock(stages().mutex);
  return stages().all;
}

void register_stage(const PythonStage& stage) {
  StageEntry entry = entry_of(stage);
  const std::string class_name =
      text_of(stage.type.attr("__module__")) + "." + text_of(stage.type.attr("__qualname__"));
  // Replaced entries are released after the lock, because that may run Python code.
  std::vector<std::pair<StageEntry, std::string>> entries;
  std::shared_ptr<const Catalogue> old;
  {
    const std::lock_guard<std::mutex> lock(stages().mutex);
    entries = stages().entries;
    old = stages().all;
  }
  const auto is_same = [&](const auto& other) {
    return other.first.kind == entry.kind && other.first.name == entry.name;
  };
  const auto found = std::find_if(entries.begin(), entries.end(), is_same);
  const bool is_taken = found == entries.end() ? registry().find(entry.kind, entry.name) != nullptr
                                               : found->second != class_name;
  if (is_taken) {
    throw InputError("", entry.kind + "/" + entry.name,
                     found == entries.end()
                         ? "croon already has a stage of this name"
                         : "the class " + found->second + " already has this name");
  }
  if (found == entries.end()) {
    entries.emplace_back(std::move(entry), class_name);
  } else {
    found->first = std::move(entry);
  }
  auto all = std::make_shared<Catalogue>(registry());
  for (const auto& [other, ignored] : entries) all->add(other);
  const std::lock_guard<std::mutex> lock(stages().mutex);
  entries.swap(stages().entries);
  stages().all = std::move(all);
}

namespace {

std::vector<params::ExtraDoc> extras_from(const py::list& extras) {
  std::vector<params::ExtraDoc> docs;
  for (const py::handle extra : extras) {
    if (std::string(py::str(extra.attr("name"))) == kCovariance.name) {
      docs.push_back(kCovariance.doc());
      continue;
    }
    const bool is_number = extra.attr("type").ptr() == reinterpret_cast<PyObject*>(&PyFloat_Type);
    docs.push_back(
        {py::str(extra.attr("name")), extra_type(is_number), py::str(extra.attr("meaning"))});
  }
  return docs;
}

void register_class(const py::dict& stage) {
  params::DataFlow flow;
  for (const py::handle name : stage["channels"]) {
    flow.add(params::needs_channels({py::str(name)}));
  }
  flow.takes = extras_from(stage["takes"]);
  flow.gives = extras_from(stage["gives"]);
  register_stage({py::str(stage["kind"]), py::str(stage["name"]), py::str(stage["summary"]),
                  py::str(stage["source"]), py::cast<int>(stage["version"]), stage["type"],
                  stage["parameters"], flow, py::cast<bool>(stage["is_rig_step"])});
}

std::string help(const std::string& which, const std::string& format) {
  return stages_help(*catalogue(), which, help_format(format));
}

}  // namespace

void bind_stages(py::module_& module) {
  module.def("register_stage", register_class);
  module.def("stages_help", help);
}

}  // namespace croon::python
