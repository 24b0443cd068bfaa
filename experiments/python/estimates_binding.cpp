#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"

namespace croon::python {
namespace {

std::shared_ptr<Cloud> python_cloud(const std::shared_ptr<const Cloud>& cloud) {
  return std::const_pointer_cast<Cloud>(cloud);  // Python has no way to change it.
}

/// The plane's normal and offset and the points off the ground; None if there is none.
py::object ground_object(const std::shared_ptr<const GroundSplit>& ground) {
  if (!ground) return py::none();
  return py::module_::import("croon._stages")
      .attr("GroundSplit")(array_from(ground->plane.normal), ground->plane.offset_m,
                           python_cloud(ground->non_ground));
}

py::dict diagnostics_dict(const Estimate& estimate) {
  py::dict dict;
  for (const auto& [name, value] : estimate.diagnostics) dict[py::str(name)] = value;
  return dict;
}

void set_diagnostics(Estimate& estimate, const py::dict& dict) {
  std::vector<Diagnostic> diagnostics;
  for (const auto& [name, value] : dict) {
    if (!py::isinstance<py::str>(name) || PyNumber_Check(value.ptr()) == 0) {
      throw InputError("", "diagnostics",
                       "expected numbers by name, found " + text_of(py::repr(name)) + " with " +
                           type_words(value));
    }
    diagnostics.emplace_back(
        py::str(name), py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(value))));
  }
  estimate.diagnostics = std::move(diagnostics);
}

void put_extra(Estimate& estimate, const std::string& name, const py::object& value) {
  if (py::isinstance<py::float_>(value)) {
    estimate.extras.put(Extra<double>{name.c_str(), ""}, py::cast<double>(value));
  } else {
    estimate.extras.put(Extra<ObjectRef>{name.c_str(), ""}, ObjectRef(value));
  }
}

py::object get_extra(const Estimate& estimate, const std::string& name) {
  if (const double* const number = estimate.extras.find(Extra<double>{name.c_str(), ""})) {
    return py::float_(*number);
  }
  return estimate.extras.get(Extra<ObjectRef>{name.c_str(), ""}).get();
}

py::object trial_object(const Estimate& estimate) {
  if (!estimate.trial) return py::none();
  const TrialName& trial = *estimate.trial;
  return py::module_::import("croon._stages")
      .attr("Trial")(trial.scene, trial.sensor, trial.number);
}

}  // namespace

Estimate estimate_from(const py::object& result, Estimate given) {
  if (py::isinstance<Estimate>(result)) return py::cast<Estimate>(result);
  if (result.is_none()) {
    throw InputError("", "advance", "expected an estimate or a 4×4 pose, found None");
  }
  given.T_target_source = pose_from(result, "advance");
  return given;
}

std::string extra_type(bool is_number) {
  return is_number ? typeid(double).name() : typeid(ObjectRef).name();
}

void bind_estimates(py::module_& module) {
  py::class_<Estimate>(module, "Estimate")
      .def_property_readonly("target", [](const Estimate& e) { return python_cloud(e.target); })
      .def_property_readonly("source", [](const Estimate& e) { return python_cloud(e.source); })
      .def_property(
          "pose", [](const Estimate& e) { return array_from(e.T_target_source); },
          [](Estimate& e, const py::object& pose) { e.T_target_source = pose_from(pose, "pose"); })
      .def_property(
          "information", [](const Estimate& e) { return object_from(e.information); },
          [](Estimate& e, const py::object& matrix) {
            e.information = matrix.is_none()
                                ? std::nullopt
                                : std::optional(information_from(matrix, "information"));
          })
      .def_property(
          "rejection",
          [](const Estimate& e) {
            return e.rejection ? py::object(py::str(*e.rejection)) : py::none();
          },
          [](Estimate& e, const py::object& reason) {
            e.rejection =
                reason.is_none() ? std::nullopt : std::optional<std::string>(py::str(reason));
          })
      .def_property("diagnostics", diagnostics_dict, set_diagnostics)
      .def_property_readonly("target_ground",
                             [](const Estimate& e) { return ground_object(e.target_ground); })
      .def_property_readonly("source_ground",
                             [](const Estimate& e) { return ground_object(e.source_ground); })
      .def_property_readonly("up", [](const Estimate& e) { return array_from(e.up()); })
      .def_property_readonly("trial", trial_object)
      .def("put", put_extra)
      .def("get", get_extra);
  py::class_<PythonRng>(module, "Rng")
      .def("bits", [](PythonRng& self) { return self.rng.bits(); })
      .def(
          "uniform",
          [](PythonRng& self, double low, double high) { return self.rng.uniform(low, high); },
          py::arg("low") = 0.0, py::arg("high") = 1.0)
      .def("below",
           [](PythonRng& self, std::int64_t count) {
             if (count < 1)
               throw InputError("", "count",
                                "expected a positive number, found " + std::to_string(count));
             return self.rng.below(static_cast<std::uint64_t>(count));
           })
      .def("normal", [](PythonRng& self) { return self.rng.normal(); })
      .def("numpy", [](PythonRng& self) {
        const py::module_ random = py::module_::import("numpy.random");
        return random.attr("Generator")(random.attr("PCG64")(self.rng.bits()));
      });
}

}  // namespace croon::python
