#pragma once

#include <cstdint>
#include <string>

#include "framework/base/error.hpp"

namespace croon {

/// The limit of the address space of this process (RLIMIT_AS), infinity if there is none.
double address_space_bytes();

/// The bytes of memory that this process may use: those of the machine, or fewer if its address
/// space has a limit (ulimit -v). The limit of a container or of a batch job is not known here.
double memory_limit_bytes();

/// Throws InputError at `at` (a file and a position in it) if `bytes`, an estimate, are more than
/// memory_limit_bytes(). `what` needs them: "a plan of 1000 trials"; `remedy` says how to need
/// less.
void require_memory(double bytes, const std::string& what, const std::string& remedy,
                    const Fault& at);

}  // namespace croon
