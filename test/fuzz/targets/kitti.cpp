// Clouds as KITTI writes them: four floats per point.
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::optional<LoadedCloud> cloud = fuzz::read_cloud_input("input.bin", data, size);
  if (!cloud) return 0;
  fuzz::require((cloud->points.size() + cloud->dropped_non_finite) * 16 == size,
                "points are lost or invented");
  return 0;
}
