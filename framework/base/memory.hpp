#pragma once

#include <filesystem>
#include <string>

#include "framework/base/error.hpp"

namespace croon {

/// The address space limit of this process (RLIMIT_AS); infinity if unlimited.
double address_space_bytes();

/// The memory limit of this process's control group, e.g. of a container or a batch job (memory.max
/// of cgroup v2, memory.limit_in_bytes of v1; the minimum over the group and its parents); infinity
/// if there is no limit or it cannot be read. `root` is an alternative root of the file system, for
/// tests.
double control_group_bytes(const std::filesystem::path& root = "/");

/// The number of bytes of memory that this process may use: the machine's memory, or less if the
/// address space (ulimit -v) or the control group is limited.
double memory_limit_bytes();

/// Throws InputError at `at` (a file and a position in it) if the estimate `bytes` exceeds
/// memory_limit_bytes(). `what` names the consumer ("a plan of 1000 trials"); `remedy` tells the
/// user how to reduce the need.
void require_memory(double bytes, const std::string& what, const std::string& remedy,
                    const Fault& at);

}  // namespace croon
