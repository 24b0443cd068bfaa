#include "framework/base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "framework/base/text.hpp"

namespace croon {
namespace {

std::string gigabytes(double bytes) { return fixed_number(bytes / 1e9, 1) + " GB"; }

}  // namespace

double address_space_bytes() {
  rlimit limit{};
  const bool is_limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_limited ? static_cast<double>(limit.rlim_cur) : std::numeric_limits<double>::infinity();
}

double memory_limit_bytes() {
  return std::min(address_space_bytes(), static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                                             static_cast<double>(::sysconf(_SC_PAGE_SIZE)));
}

void require_memory(double bytes, const std::string& what, const std::string& remedy,
                    const Fault& at) {
  const double limit = memory_limit_bytes();
  if (bytes <= limit) return;
  throw InputError(at.file, at.where,
                   what + " takes about " + gigabytes(bytes) + " of memory, more than the " +
                       gigabytes(limit) + " of this machine or process: " + remedy);
}

}  // namespace croon
