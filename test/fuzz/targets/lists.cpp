// The lists of clouds and poses of the authors' recordings. A list that is written and read again
// has the same elements.
#include "framework/io/opencalib_files.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("list.txt", data, size);
  const auto again = [](const std::string& text) {
    return fuzz::write_input("again.txt", reinterpret_cast<const std::uint8_t*>(text.data()),
                             text.size());
  };
  std::vector<ListedCloud> clouds;
  if (fuzz::is_taken([&] { clouds = read_cloud_list(path); })) {
    const std::vector<ListedCloud> read = read_cloud_list(again(cloud_list_text(clouds)));
    fuzz::require(cloud_list_text(read) == cloud_list_text(clouds),
                  "a list is read back as another");
  }
  std::vector<ListedPose> poses;
  if (fuzz::is_taken([&] { poses = read_pose_list(path); })) {
    fuzz::require(read_pose_list(again(pose_list_text(poses))).size() == poses.size(),
                  "poses are lost");
  }
  return 0;
}
