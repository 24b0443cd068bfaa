#pragma once

#include "framework/stage/catalogue.hpp"

namespace croon {

/// The stages of this build: those in stages/ whose libraries were found, and CROON_EXTRA_STAGES.
/// Defined in a generated file, see registry/CMakeLists.txt.
const Catalogue& registry();

}  // namespace croon
