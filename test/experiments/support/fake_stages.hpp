#pragma once

#include "framework/stage/catalogue.hpp"

namespace croon::test {

/// A few small stages, so that tests of the engine depend on no real one:
/// - dataset `fake` {scenes, sensors, truth, points, unreadable, channels, one_rig}: random clouds;
/// sensors
///   s0, s1, ...; the cloud of sensor `unreadable` cannot be read (-2: the reference's, -1: none);
/// - yaw_search `coarse` {step_deg}, `fine` {levels};
/// - step `drift` {size_m, search}: moves the pose by random numbers and by how many points the
/// clouds have;
/// - step `give` {value} gives the extra token, `give_other` one of another type, `take` takes it;
/// - step `gather` sees the whole rig, and gives all estimates the mean of their x;
/// - step `need` needs the channel time of both clouds, and ring of the sensor's;
/// - step `behave` {how}: nothing, rejects, fails, ..., see fake_stages.cpp.
Catalogue fake_catalogue();

}  // namespace croon::test
