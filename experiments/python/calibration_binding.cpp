// Calibration of rigs from clouds in memory.
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/estimates.hpp"
#include "experiments/python/interpreter.hpp"
#include "experiments/python/interruptible.hpp"
#include "experiments/python/stage_catalogue.hpp"
#include "experiments/report/calibration_document.hpp"
#include "framework/calibration/calibrate_rig.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/calibration/rig_extrinsics.hpp"

namespace croon::python {
namespace {

using Poses = std::map<std::string, RigidTransform>;

/// The scan of one sensor from a cloud in memory.
SensorScan scan_of(const std::string& sensor, LoadedCloud cloud, const Poses& nominal) {
  SensorScan scan;
  scan.sensor = sensor;
  std::vector<std::string> channels;
  for (const Channel& channel : cloud.channels) channels.push_back(channel.name);
  scan.channels = std::move(channels);
  const auto pose = nominal.find(sensor);
  if (pose != nominal.end()) scan.nominal = pose->second;
  const auto shared = std::make_shared<const LoadedCloud>(std::move(cloud));
  scan.load = [shared] { return *shared; };
  return scan;
}

/// Converts one scene of the Python list: its name, and tuples (sensor, name in errors, array), the
/// reference first.
Scene scene_from(const py::handle& item, const Poses& nominal) {
  const auto parts = py::cast<py::tuple>(item);
  Scene scene;
  scene.name = text_of(parts[0]);
  bool is_reference = true;
  for (const py::handle entry : parts[1]) {
    const auto cloud = py::cast<py::tuple>(entry);
    SensorScan scan =
        scan_of(text_of(cloud[0]), recorded_cloud_from(cloud[2], text_of(cloud[1])), nominal);
    if (is_reference) {
      scene.reference = std::move(scan);
    } else {
      scene.sensors.push_back(std::move(scan));
    }
    is_reference = false;
  }
  return scene;
}

Poses poses_from(const py::dict& dict) {
  Poses poses;
  for (const auto& [name, pose] : dict) {
    const std::string sensor = text_of(name);
    poses[sensor] =
        pose_from(py::reinterpret_borrow<py::object>(pose), "nominal[\"" + sensor + "\"]");
  }
  return poses;
}

/// Converts the poses to T_reference_sensor: if the reference has a pose too, they are in another
/// frame.
Poses in_reference(Poses poses, const std::string& reference) {
  const auto own = poses.find(reference);
  if (own == poses.end()) return poses;
  const RigidTransform T_reference_given = own->second.inverse();
  poses.erase(own);
  for (auto& [sensor, pose] : poses) pose = T_reference_given * pose;
  return poses;
}

CalibratedRig calibrated(const py::list& list, const py::dict& nominal, const py::dict& options) {
  const Poses poses = in_reference(poses_from(nominal), text_of(options["reference"]));
  std::vector<Scene> scenes;
  for (const py::handle item : list) scenes.push_back(scene_from(item, poses));
  CalibrationOptions how;
  how.pipeline = text_of(options["pipeline"]);
  if (!options["text"].is_none()) how.pipeline_text = text_of(options["text"]);
  how.from_scratch = py::cast<bool>(options["from_scratch"]);
  how.at_rest = py::cast<bool>(options["at_rest"]);
  how.seed = py::cast<std::uint64_t>(options["seed"]);
  how.jobs = py::cast<int>(options["jobs"]);
  std::vector<std::string> unused;
  for (const py::handle sentence : options["unused"]) unused.push_back(text_of(sentence));
  const std::shared_ptr<const Catalogue> stages = catalogue();
  CalibratedRig rig;
  interruptible([&](const std::function<void()>& check) {
    how.on_progress = [&](const std::string&, double) { check(); };
    rig = calibrate_rig(scenes, how, *stages);
    check();
    rig.unused.insert(rig.unused.begin(), unused.begin(), unused.end());
  });
  warn(rig.notes);
  return rig;
}

py::list list_of(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(text);
  return list;
}

py::object pose_or_none(const std::optional<RigidTransform>& pose) {
  return pose ? py::object(array_from(*pose)) : py::none();
}

py::object matrix_or_none(const std::optional<PoseCovariance>& covariance) {
  return covariance ? py::object(array_from(covariance->matrix)) : py::none();
}

/// For each scene its name, pose, covariance, observability and reason.
py::list scene_estimates(const std::vector<SceneEstimate>& estimates) {
  py::list list;
  for (const SceneEstimate& estimate : estimates) {
    list.append(py::make_tuple(estimate.scene, pose_or_none(estimate.T_reference_sensor),
                               matrix_or_none(estimate.covariance), words_from(estimate.covariance),
                               estimate.reason));
  }
  return list;
}

/// For each sensor the fields of croon.CalibratedSensor, in their order.
py::list sensors(const CalibratedRig& rig) {
  py::list list;
  for (const CalibratedSensor& sensor : rig.sensors) {
    list.append(py::make_tuple(
        sensor.sensor, sensor.is_accepted, pose_or_none(sensor.T_reference_sensor),
        matrix_or_none(sensor.covariance), words_from(sensor.covariance), list_of(sensor.reasons),
        list_of(sensor.advice), pose_or_none(sensor.nominal), is_contradicted(sensor.refit),
        scene_estimates(sensor.scenes)));
  }
  return list;
}

/// For each scene its name, the velocity (six numbers) and its covariance.
py::list motion(const CalibratedRig& rig) {
  py::list list;
  for (const SceneMotionEstimate& scene : rig.motion) {
    const Vector6d velocity = vector_of(scene.velocity);
    py::array_t<double> array(6);
    std::copy(velocity.data(), velocity.data() + 6, array.mutable_data());
    list.append(py::make_tuple(scene.scene, array, array_from(scene.covariance)));
  }
  return list;
}

py::object ground(const CalibratedRig& rig) {
  if (!rig.ground) return py::none();
  const GroundPose& pose = *rig.ground;
  return py::make_tuple(pose.roll_rad, pose.pitch_rad, pose.height_m, pose.roll_std_rad,
                        pose.pitch_std_rad, pose.height_std_m);
}

/// The texts of the files by file name; if `T_parent_reference` is not None, poses are in the frame
/// `parent`, and the reference is the first sensor.
py::dict files(const CalibratedRig& rig, const std::string& format, bool with_rejected,
               const std::string& parent, const py::object& T_parent_reference) {
  Extrinsics extrinsics = extrinsics_of(rig);
  if (!T_parent_reference.is_none()) {
    const RigidTransform pose = pose_from(T_parent_reference, "base");
    extrinsics = in_frame(extrinsics, parent, pose);
    extrinsics.poses.insert(extrinsics.poses.begin(), {rig.reference, pose});
  }
  py::dict texts;
  for (const ExtrinsicsFile& file : write_extrinsics(extrinsics, format, with_rejected)) {
    texts[py::str(file.name)] = py::str(file.text);
  }
  return texts;
}

}  // namespace

void bind_calibration(py::module_& module) {
  using R = CalibratedRig;
  py::class_<R>(module, "CalibratedRig")
      .def_readonly("reference", &R::reference)
      .def_readonly("composition", &R::composition)
      .def_readonly("composition_reason", &R::composition_reason)
      .def("warnings", [](const R& rig) { return list_of(rig.warnings); })
      .def("unused", [](const R& rig) { return list_of(rig.unused); })
      .def("sensors", sensors)
      .def("motion", motion)
      .def("ground", ground)
      .def("files", files)
      .def("text", [](const R& rig) { return experiments::calibration_text(rig, false); });
  module.def("calibrate_rig", calibrated);
  module.def("pipelines", [] { return list_of(recommended_pipeline_names()); });
  module.def("pipeline_text", recommended_pipeline_text);
}

}  // namespace croon::python
