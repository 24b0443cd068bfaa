#include "experiments/run/data_root.hpp"

#include <cstdlib>

namespace croon::experiments {

std::filesystem::path data_root(const std::filesystem::path& asked) {
  if (!asked.empty()) return asked;
  const char* const set = std::getenv("CROON_DATA");
  return set != nullptr && *set != '\0' ? set : "data";
}

}  // namespace croon::experiments
