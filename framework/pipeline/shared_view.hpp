#pragma once

#include "framework/params/slot.hpp"
#include "framework/registration/sensor_view.hpp"
#include "framework/stage/preprocessor.hpp"

namespace croon {

/// The view of `cloud` for judging poses, computed once for all starts and steps; `thinning` makes
/// its density even.
std::shared_ptr<const SensorView> shared_view(const Cloud& cloud,
                                              const params::Slot<Preprocessor>& thinning);

}  // namespace croon
