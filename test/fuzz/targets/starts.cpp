// Files of starts, for two scenes of two sensors.
#include "experiments/run/starts.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  static const std::vector<Scene> scenes = [] {
    std::vector<Scene> both(2);
    for (std::size_t i = 0; i < both.size(); ++i) {
      both[i].name = i == 0 ? "000000" : "000001";
      both[i].sensors.resize(2);
      both[i].sensors[0].sensor = "left";
      both[i].sensors[1].sensor = "right";
    }
    return both;
  }();
  const std::filesystem::path path = fuzz::write_input("starts.csv", data, size);
  fuzz::is_taken([&] { experiments::read_start_file(path, scenes); });
  return 0;
}
