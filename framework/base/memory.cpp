#include "framework/base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "framework/base/text.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The number in `file`; infinity if it does not contain one, e.g. "max".
double limit_in(const fs::path& file) {
  double bytes = 0.0;
  return std::ifstream(file) >> bytes ? bytes : kNoLimit;
}

/// The minimum limit of the group `path` and its parents, in files `name` below `mount`.
double min_limit(const fs::path& mount, fs::path path, const char* name) {
  double minimum = limit_in(mount / name);
  // Inside a container its own group is the root, whatever path /proc reports.
  for (path = path.relative_path(); !path.empty(); path = path.parent_path()) {
    minimum = std::min(minimum, limit_in(mount / path / name));
  }
  return minimum;
}

std::string gigabytes(double bytes) { return fixed_number(bytes / 1e9, 1) + " GB"; }

}  // namespace

double address_space_bytes() {
  rlimit limit{};
  const bool is_limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_limited ? static_cast<double>(limit.rlim_cur) : kNoLimit;
}

double control_group_bytes(const fs::path& root) {
  double minimum = kNoLimit;
  std::ifstream groups(root / "proc/self/cgroup");
  // A line is NUMBER:CONTROLLERS:PATH; version 2 has no controllers.
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path path = line.substr(second + 1);
    if (controllers.empty()) {
      minimum = std::min(minimum, min_limit(root / "sys/fs/cgroup", path, "memory.max"));
    } else if (controllers == "memory") {
      minimum = std::min(minimum,
                         min_limit(root / "sys/fs/cgroup/memory", path, "memory.limit_in_bytes"));
    }
  }
  return minimum;
}

double memory_limit_bytes() {
  const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                         static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return std::min({address_space_bytes(), control_group_bytes(), machine});
}

void require_memory(double bytes, const std::string& what, const std::string& remedy,
                    const Fault& at) {
  const double limit = memory_limit_bytes();
  if (bytes <= limit) return;
  throw InputError(at.file, at.where,
                   what + " takes about " + gigabytes(bytes) + " of memory, more than the " +
                       gigabytes(limit) + " of this machine, job or process: " + remedy);
}

}  // namespace croon
