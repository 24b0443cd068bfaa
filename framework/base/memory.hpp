#pragma once

#include <filesystem>
#include <string>

#include "framework/base/error.hpp"

namespace croon {

/// The limit of the address space of this process (RLIMIT_AS), infinity if there is none.
double address_space_bytes();

/// The memory that the control group of this process may use, that of a container or of a batch job
/// (memory.max of cgroup v2, memory.limit_in_bytes of v1; the least of the group and those above
/// it); infinity if there is no limit or it cannot be read. `root` is another root of the file
/// system, for tests.
double control_group_bytes(const std::filesystem::path& root = "/");

/// The bytes of memory that this process may use: those of the machine, or fewer if its address
/// space (ulimit -v) or its control group has a limit.
double memory_limit_bytes();

/// Throws InputError at `at` (a file and a position in it) if `bytes`, an estimate, are more than
/// memory_limit_bytes(). `what` needs them: "a plan of 1000 trials"; `remedy` says how to need
/// less.
void require_memory(double bytes, const std::string& what, const std::string& remedy,
                    const Fault& at);

}  // namespace croon
