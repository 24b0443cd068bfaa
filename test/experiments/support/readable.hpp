#pragma once

#include <string>
#include <vector>

#include "framework/picture/drawing.hpp"

namespace croon::test {

/// The faults that keep a reader from reading `drawing`: marks and texts beyond the page, and texts
/// on top of each other. Empty if there are none.
std::vector<std::string> unreadable_parts(const Drawing& drawing);

}  // namespace croon::test
