// PCD files. A cloud that is read, written and read again is the same cloud.
#include "framework/io/pcd_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("input.pcd", data, size);
  const bool header_is_taken = fuzz::is_taken([&] { check_point_cloud_file(path); });
  LoadedCloud cloud;
  if (!fuzz::is_taken([&] { cloud = read_point_cloud(path); })) return 0;
  fuzz::require(header_is_taken, "the check of the header refuses what the reader takes");
  MeasuredCloud measured;
  measured.points = cloud.points;
  measured.intensity.resize(cloud.points.size());
  measured.ring.resize(cloud.points.size());
  measured.time_s.resize(cloud.points.size());
  const std::filesystem::path again = path.parent_path() / "again.pcd";
  write_pcd(again, measured);
  fuzz::require(read_point_cloud(again).points == cloud.points, "a cloud is read back as another");
  return 0;
}
