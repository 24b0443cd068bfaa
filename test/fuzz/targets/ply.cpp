// PLY files. A cloud that is read, written and read again is the same cloud.
#include "framework/io/ply_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("input.ply", data, size);
  const bool header_is_taken = fuzz::is_taken([&] { check_point_cloud_file(path); });
  LoadedCloud cloud;
  if (!fuzz::is_taken([&] { cloud = read_point_cloud(path); })) return 0;
  fuzz::require(header_is_taken, "the check of the header refuses what the reader takes");
  const std::filesystem::path again = path.parent_path() / "again.ply";
  for (const PlyFormat format : {PlyFormat::binary_little_endian, PlyFormat::ascii}) {
    write_ply(again, cloud.points, format);
    fuzz::require(read_point_cloud(again).points == cloud.points,
                  "a cloud is read back as another");
  }
  return 0;
}
