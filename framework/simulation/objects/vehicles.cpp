#include "framework/simulation/objects/vehicles.hpp"

#include <stdexcept>

#include "framework/simulation/objects/vehicle_types.hpp"

namespace croon::simulation {
namespace {

Mesh make_mesh(VehicleType type, Rng& rng) {
  switch (type) {
    case VehicleType::car:
      return make_car(rng);
    case VehicleType::van:
      return make_van(rng);
    case VehicleType::truck:
      return make_truck(rng);
    case VehicleType::bus:
      return make_bus(rng);
  }
  throw std::logic_error("make_vehicle: no such type");
}

}  // namespace

Vehicle make_vehicle(VehicleType type, Rng& rng) {
  Vehicle vehicle;
  vehicle.mesh = make_mesh(type, rng);
  Eigen::Vector3f reach = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& vertex : vehicle.mesh.vertices) {
    reach = reach.cwiseMax(vertex.cwiseAbs());
  }
  vehicle.size_m = reach.cast<double>().cwiseProduct(Eigen::Vector3d(2.0, 2.0, 1.0));
  return vehicle;
}

}  // namespace croon::simulation
