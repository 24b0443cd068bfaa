// Files of velocities, for two scenes.
#include "experiments/run/given_velocities.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  static const std::vector<Scene> scenes = [] {
    std::vector<Scene> both(2);
    both[0].name = "000000";
    both[1].name = "000001";
    return both;
  }();
  const std::filesystem::path path = fuzz::write_input("velocities.csv", data, size);
  fuzz::is_taken([&] { experiments::read_velocity_file(path, scenes); });
  return 0;
}
