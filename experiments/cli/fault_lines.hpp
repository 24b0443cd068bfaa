#pragma once

#include <ostream>

#include "framework/base/error.hpp"

namespace croon::experiments {

/// Prints each fault as one line, `croon: FILE: WHERE: MESSAGE`.
inline void print_faults(const InputError& error, std::ostream& err) {
  for (const Fault& fault : error.faults()) err << "croon: " << fault.line() << "\n";
}

}  // namespace croon::experiments
