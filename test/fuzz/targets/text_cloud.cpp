// Points in text. A cloud that is read, written as PCD and read again is the same cloud.
#include "framework/io/pcd_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::optional<LoadedCloud> cloud = fuzz::read_cloud_input("input.csv", data, size);
  if (!cloud) return 0;
  const std::filesystem::path again = fuzz::write_input("again.pcd", data, 0);
  // A header may name a field by what is no word.
  if (!fuzz::is_taken([&] { write_pcd(again, *cloud); })) return 0;
  fuzz::require(fuzz::is_equal(read_point_cloud(again), *cloud), "a cloud is read back as another");
  return 0;
}
