#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// What stands beside a road; each faces x (a lamp's arm points there, a sign's plate looks there),
/// z up, origin at its foot.
Mesh make_lamp(Rng& rng);
Mesh make_traffic_light(Rng& rng);
Mesh make_sign(Rng& rng);
Mesh make_bollard(Rng& rng);
Mesh make_bin(Rng& rng);
Mesh make_bench(Rng& rng);
/// A roof on posts with a back wall and ends of glass.
Mesh make_bus_stop(Rng& rng);
/// A gantry with signs over a road of `width_m`, across x, about it in y.
Mesh make_gantry(double width_m, Rng& rng);

}  // namespace croon::simulation
