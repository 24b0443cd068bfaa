#pragma once

#include "framework/params/slot.hpp"
#include "framework/registration/sensor_view.hpp"
#include "framework/stage/preprocessor.hpp"

namespace croon {

/// The view of `cloud` that poses are judged by, made once for all starts and steps: `thinning`
/// makes it even.
std::shared_ptr<const SensorView> shared_view(const Cloud& cloud,
                                              const params::Slot<Preprocessor>& thinning);

}  // namespace croon
