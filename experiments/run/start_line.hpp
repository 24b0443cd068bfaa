#pragma once

#include <string>

#include "experiments/file/start_rule.hpp"

namespace croon::experiments {

/// A line of a file of starts.
struct StartLine {
  std::string scene;
  std::string sensor;
  int trial = 0;
  Start start;
};

/// The parts of the line `text`. Throws InputError: expected ..., found ...
StartLine read_start_line(const std::string& text);

/// Throws the InputError of a line: expected ..., found ...
[[noreturn]] void refuse(const std::string& expected, const std::string& found);

}  // namespace croon::experiments
