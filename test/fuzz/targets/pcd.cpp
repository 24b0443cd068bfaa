// PCD files. A cloud that is read, written and read again is the same cloud.
#include "framework/io/pcd_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::optional<LoadedCloud> cloud = fuzz::read_cloud_input("input.pcd", data, size);
  if (!cloud) return 0;
  MeasuredCloud measured;
  measured.points = cloud->points;
  measured.intensity.resize(cloud->points.size());
  measured.ring.resize(cloud->points.size());
  measured.time_s.resize(cloud->points.size());
  const std::filesystem::path again = fuzz::write_input("again.pcd", data, 0);
  write_pcd(again, measured);
  fuzz::require(read_point_cloud(again).points == cloud->points, "a cloud is read back as another");
  return 0;
}
