#include "test/support/data_root.hpp"

#include <vector>

namespace croon::test {

std::filesystem::path data_root() {
  const std::filesystem::path source = CROON_SOURCE_DIR;
  std::vector<std::filesystem::path> candidates = {source / ".." / "shared" / "data",
                                                   source / "data"};
  if (const char* set = std::getenv("CROON_DATA")) candidates.insert(candidates.begin(), set);
  for (const std::filesystem::path& candidate : candidates) {
    if (std::filesystem::is_directory(candidate / "opencalib")) {
      return std::filesystem::weakly_canonical(candidate);
    }
  }
  return {};
}

}  // namespace croon::test
