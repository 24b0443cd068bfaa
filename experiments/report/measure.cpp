#include "experiments/report/measure.hpp"

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

}  // namespace croon::experiments
