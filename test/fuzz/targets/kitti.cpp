// Clouds as KITTI writes them: four floats per point.
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("input.bin", data, size);
  const bool header_is_taken = fuzz::is_taken([&] { check_point_cloud_file(path); });
  LoadedCloud cloud;
  if (!fuzz::is_taken([&] { cloud = read_point_cloud(path); })) return 0;
  fuzz::require(header_is_taken, "the check of the size refuses what the reader takes");
  fuzz::require((cloud.points.size() + cloud.dropped_non_finite) * 16 == size,
                "points are lost or invented");
  return 0;
}
