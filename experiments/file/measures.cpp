#include "experiments/file/measures.hpp"

#include <stdexcept>

#include "framework/base/angles.hpp"

namespace croon::experiments {

Measures measures_of(const PoseError& error) {
  return {deg_from_rad(error.dof(0)),
          deg_from_rad(error.dof(1)),
          deg_from_rad(error.dof(2)),
          error.dof(3),
          error.dof(4),
          error.dof(5),
          deg_from_rad(error.rotation_rad),
          error.translation_m};
}

std::string name_with_unit(const Measure& measure) {
  return std::string(measure.name) + "_" + measure.unit;
}

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const Measure& measure : kMeasures) names.emplace_back(measure.name);
  return names;
}

std::size_t measure_index(std::string_view name) {
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    if (name == kMeasures[k].name) return k;
  }
  throw std::logic_error("unknown measure \"" + std::string(name) + "\"");
}

}  // namespace croon::experiments
