// The scenes of datasets, including simulated ones.
#include <nlohmann/json.hpp>

#include "experiments/python/arrays.hpp"
#include "experiments/python/bindings.hpp"
#include "experiments/python/interpreter.hpp"
#include "experiments/python/stage_catalogue.hpp"
#include "experiments/run/run_request.hpp"
#include "framework/params/json_file.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::python {
namespace {

const SensorScan* find_scan(const Scene& scene, const std::string& sensor) {
  if (scene.reference.sensor == sensor) return &scene.reference;
  for (const SensorScan& scan : scene.sensors) {
    if (scan.sensor == sensor) return &scan;
  }
  return nullptr;
}

py::array cloud_of(const Scene& scene, const std::string& sensor) {
  const SensorScan* const scan = find_scan(scene, sensor);
  if (scan == nullptr) {
    std::vector<std::string> names = {scene.reference.sensor};
    for (const SensorScan& other : scene.sensors) names.push_back(other.sensor);
    throw InputError("", "sensor",
                     "there is no sensor \"" + sensor + "\"" + name_hint(sensor, names));
  }
  LoadedCloud cloud;
  {
    const WithoutGil no_gil;
    cloud = scan->load();
  }
  return array_of_file(cloud, scan->file);
}

/// The known poses of sensors.
template <std::optional<RigidTransform> SensorScan::*pose>
py::dict poses_of(const Scene& scene) {
  py::dict poses;
  for (const SensorScan& scan : scene.sensors) {
    if (scan.*pose) poses[py::str(scan.sensor)] = array_from(*(scan.*pose));
  }
  return poses;
}

py::list sensors_of(const Scene& scene) {
  py::list names;
  for (const SensorScan& scan : scene.sensors) names.append(scan.sensor);
  return names;
}

/// The scenes of the dataset described by the JSON `text`.
py::list scenes(const std::string& text, const std::string& name, const std::string& data) {
  const std::shared_ptr<const Catalogue> stages = catalogue();
  std::vector<Scene> scenes;
  std::vector<Fault> notes;
  {
    const WithoutGil no_gil;
    std::vector<Fault> faults;
    const nlohmann::json json = params::parse_json(text, name, faults);
    const auto dataset = stages->slot<Dataset>(params::Node(json, name, faults).noting(notes));
    if (!faults.empty()) throw InputError(std::move(faults));
    scenes = dataset->scenes(experiments::data_root(data));
  }
  warn(notes);
  py::list list;
  for (Scene& scene : scenes) list.append(py::cast(std::move(scene)));
  return list;
}

}  // namespace

void bind_datasets(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def_readonly("name", &Scene::name)
      .def_readonly("kind", &Scene::kind)
      .def_property_readonly("reference", [](const Scene& scene) { return scene.reference.sensor; })
      .def_property_readonly("sensors", sensors_of)
      .def("cloud", cloud_of)
      .def_property_readonly("truth", poses_of<&SensorScan::truth>)
      .def_property_readonly("nominal", poses_of<&SensorScan::nominal>)
      .def_property_readonly("initial", poses_of<&SensorScan::initial>);
  module.def("scenes", scenes);
}

}  // namespace croon::python
