#pragma once

#include <string>

namespace croon::experiments {

/// What the program answers: its exit code, and both of its outputs.
struct Answer {
  int code = -1;
  std::string text;
};

/// Runs the program that was built beside the tests, through a shell.
Answer croon(const std::string& arguments);

}  // namespace croon::experiments
