// PLY files. A cloud that is read, written and read again is the same cloud.
#include "framework/io/ply_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::optional<LoadedCloud> cloud = fuzz::read_cloud_input("input.ply", data, size);
  if (!cloud) return 0;
  const std::filesystem::path again = fuzz::write_input("again.ply", data, 0);
  for (const PlyFormat format : {PlyFormat::binary_little_endian, PlyFormat::ascii}) {
    write_ply(again, cloud->points, format);
    fuzz::require(read_point_cloud(again).points == cloud->points,
                  "a cloud is read back as another");
  }
  return 0;
}
