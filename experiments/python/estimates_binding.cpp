#include <algorithm>

#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"
#include "experiments/run/trial_record.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon::python {
namespace {

std::shared_ptr<Cloud> python_cloud(const std::shared_ptr<const Cloud>& cloud) {
  return std::const_pointer_cast<Cloud>(cloud);  // Python cannot change it.
}

/// The plane's normal and offset and the non-ground points; None without a ground.
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

void set_diagnostics(Estimate& estimate, const py::object& numbers) {
  if (!py::isinstance<py::dict>(numbers)) {
    throw InputError("", "diagnostics", "expected a dict, found " + type_words(numbers));
  }
  std::vector<Diagnostic> diagnostics;
  for (const auto& [name, value] : py::dict(numbers)) {
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

py::object text_object(const std::optional<std::string>& text) {
  return text ? py::object(py::str(*text)) : py::none();
}

void set_information(Estimate& estimate, const py::object& matrix) {
  estimate.information.reset();
  if (!matrix.is_none()) estimate.information = matrix6_from(matrix, "information");
}

py::object covariance_object(const Estimate& estimate) {
  return estimate.covariance ? py::object(array_from(estimate.covariance->matrix)) : py::none();
}

void set_covariance(Estimate& estimate, const py::object& matrix) {
  estimate.covariance.reset();
  if (matrix.is_none()) return;
  const Matrix6d covariance = matrix6_from(matrix, "covariance");
  if (!is_covariance(covariance)) {
    throw InputError("", "covariance",
                     "expected a symmetric matrix without negative eigenvalues, found another");
  }
  estimate.covariance = PoseCovariance{covariance, {}};
}

void set_observability(Estimate& estimate, const py::object& words) {
  if (!estimate.covariance) {
    throw InputError("", "observability", "expected a covariance to be assigned first, found none");
  }
  if (!py::isinstance<py::dict>(words)) {
    throw InputError("", "observability", "expected a dict, found " + type_words(words));
  }
  for (const auto& [name, word] : py::dict(words)) {
    const auto dof = std::find(kDofNames.begin(), kDofNames.end(), text_of(py::str(name)));
    const std::optional<Observability> known = observability_of(text_of(py::str(word)));
    if (dof == kDofNames.end() || !known) {
      throw InputError("", "observability",
                       "expected determined, weak or unobservable for roll, pitch, yaw, x, y or z, "
                       "found " +
                           text_of(py::repr(name)) + ": " + text_of(py::repr(word)));
    }
    estimate.covariance->dofs.at(static_cast<std::size_t>(dof - kDofNames.begin())) = *known;
  }
}

/// The text of a str; nothing for None. Other values, such as `rejection = False`, are errors.
std::optional<std::string> reason_from(const py::object& reason, const char* attribute) {
  if (reason.is_none()) return std::nullopt;
  if (!py::isinstance<py::str>(reason) || py::len(reason) == 0) {
    throw InputError(
        "", attribute,
        "expected None or a reason, found " +
            (py::isinstance<py::str>(reason) ? std::string("an empty str") : type_words(reason)));
  }
  return text_of(reason);
}

void set_rejection(Estimate& estimate, const py::object& reason) {
  estimate.rejection = reason_from(reason, "rejection");
}

void set_failure(RigEstimate& estimate, const py::object& reason) {
  estimate.failure = reason_from(reason, "failure").value_or("");
}

py::object trial_object(const Estimate& estimate) {
  const experiments::TrialId* const trial = estimate.extras.find(experiments::kTrialId);
  if (trial == nullptr) return py::none();
  return py::module_::import("croon._stages")
      .attr("Trial")(trial->scene, trial->sensor, trial->trial);
}

}  // namespace

py::object words_from(const std::optional<PoseCovariance>& covariance) {
  if (!covariance) return py::none();
  py::dict words;
  for (std::size_t i = 0; i < kDofNames.size(); ++i) {
    words[py::str(kDofNames[i])] = name_of(covariance->dofs[i]);
  }
  return std::move(words);
}

Estimate estimate_from(const py::object& result, Estimate given) {
  if (py::isinstance<Estimate>(result)) return py::cast<Estimate>(result);
  if (result.is_none()) {
    throw InputError("", "advance", "expected an estimate or a 4×4 pose, found None");
  }
  given.set_pose(pose_from(result, "advance"));
  return given;
}

std::string extra_type(bool is_number) {
  return is_number ? typeid(double).name() : typeid(ObjectRef).name();
}

void bind_estimates(py::module_& module) {
  using E = Estimate;
  py::class_<E>(module, "Estimate",
                "The estimate of one sensor's pose, passed from step to step of a pipeline.")
      .def_property_readonly(
          "target", [](const E& e) { return python_cloud(e.target); },
          "The reference's cloud, preprocessed so far.")
      .def_property_readonly(
          "source", [](const E& e) { return python_cloud(e.source); },
          "The sensor's cloud, preprocessed so far.")
      .def_property(
          "pose", [](const E& e) { return array_from(e.T_target_source); },
          [](E& e, const py::object& pose) { e.set_pose(pose_from(pose, "pose")); },
          "The pose T_target_source, 4×4, float64: a copy. Assign a changed pose; the information\n"
          "and the covariance are then None until they are assigned, too.")
      .def_property(
          "information", [](const E& e) { return object_from(e.information); }, set_information,
          "The information matrix computed by this step, 6×6: roll, pitch, yaw (rad), x, y, z "
          "(m);\n"
          "None if it computed none.")
      .def_property("covariance", covariance_object, set_covariance,
                    "The covariance of the pose, 6×6: roll, pitch, yaw (rad), x, y, z (m) in the\n"
                    "target's frame; None if no step estimated it. Assign it after the pose.")
      .def_property(
          "observability", [](const E& e) { return words_from(e.covariance); }, set_observability,
          "How well the data constrain each degree of freedom, by name: determined, weak or\n"
          "unobservable; None without a covariance. Assign a dict after the covariance.")
      .def_property(
          "rejection", [](const E& e) { return text_object(e.rejection); }, set_rejection,
          "Reason to reject the pose; None if it is not rejected.")
      .def_property("diagnostics", diagnostics_dict, set_diagnostics,
                    "Diagnostics of this step, numbers by name: a copy. Assign a dict.")
      .def_property_readonly(
          "target_ground", [](const E& e) { return ground_object(e.target_ground); },
          "The ground of the target, a GroundSplit; None until a step has found it.")
      .def_property_readonly(
          "source_ground", [](const E& e) { return ground_object(e.source_ground); },
          "The ground of the source, a GroundSplit; None until a step has found it.")
      .def_property_readonly(
          "up", [](const E& e) { return array_from(e.up()); },
          "The axis of yaw in the target's frame: the ground's normal, or z if unknown.")
      .def_property_readonly(
          "trial", trial_object,
          "The Trial of this estimate; None outside experiments. The results of a\n"
          "step must not depend on it.")
      .def("put", put_extra, py::arg("name"), py::arg("value"),
           "Stores a value for later steps, see croon.extra.")
      .def("get", get_extra, py::arg("name"),
           "The value stored by an earlier step. Raises StageError if there is none.");
  py::class_<RigEstimate>(module, "RigEstimate",
                          "The estimate of one sensor's pose in one scene of a trial.")
      .def_readonly("scene", &RigEstimate::scene, "The scene's name.")
      .def_readonly(
          "target", &RigEstimate::target,
          "The sensor that defines the frame of the pose: the reference, or one of a pair.")
      .def_readonly("source", &RigEstimate::source, "The sensor whose pose is estimated.")
      .def_readonly("scenes", &RigEstimate::scenes,
                    "The number of scenes of the trial that have the sensor.")
      .def_readonly("estimate", &RigEstimate::estimate,
                    "The Estimate, which may be changed in place.")
      .def_property(
          "failure", [](const RigEstimate& e) { return e.failure; }, set_failure,
          "Empty, or why the step cannot continue with this estimate.");
}

}  // namespace croon::python
