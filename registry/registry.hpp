#pragma once

#include "framework/stage/catalogue.hpp"

namespace croon {

/// The stages of this build: those in stages/ whose libraries are there, and those of
/// CROON_EXTRA_STAGES.
const Catalogue& registry();

}  // namespace croon
