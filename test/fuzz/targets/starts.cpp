// Files of starts and of poses of other programs, for two scenes of two sensors.
#include "experiments/run/starts.hpp"
#include "experiments/run/pose_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  static const std::vector<experiments::SceneGroup> scenes = [] {
    std::vector<experiments::SceneGroup> both(2);
    for (std::size_t i = 0; i < both.size(); ++i) {
      both[i].name = i == 0 ? "000000" : "000001";
      both[i].pairs.resize(2);
      both[i].pairs[0].name = "left";
      both[i].pairs[1].name = "right";
    }
    return both;
  }();
  const std::filesystem::path path = fuzz::write_input("starts.csv", data, size);
  fuzz::is_taken([&] { experiments::read_start_file(path, scenes); });
  static const experiments::DatasetNames names(scenes);
  fuzz::is_taken([&] {
    experiments::read_pose_file(path, {experiments::kStartHeader, experiments::kPoseHeader}, names,
                                [](const experiments::PoseLine&) {});
  });
  return 0;
}
