#pragma once

#include <string>
#include <vector>

namespace croon::experiments {

/// Runs the program that was built beside the tests, without its output, and kills it (SIGKILL)
/// after `delay_s` seconds. Whether it was killed; else it had ended by itself.
bool kill_croon_after(double delay_s, const std::vector<std::string>& arguments);

}  // namespace croon::experiments
