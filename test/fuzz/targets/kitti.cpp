// Clouds as KITTI and nuScenes write them: rows of floats.
#include <string_view>

#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::optional<LoadedCloud> cloud = fuzz::read_cloud_input("input.bin", data, size);
  if (!cloud) return 0;
  // Other formats go by their first bytes.
  if (size == 0 || std::string_view("#Vp\x93P").find(static_cast<char>(*data)) < 5) return 0;
  const std::size_t points = cloud->points.size() + cloud->dropped_non_finite + cloud->dropped_zero;
  const std::size_t columns = 3 + cloud->channels.size();
  fuzz::require(points * 4 * columns == size, "points are lost or invented");
  return 0;
}
