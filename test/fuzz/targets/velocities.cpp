// Files of velocities, for two scenes.
#include "experiments/run/given_velocities.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  static const std::vector<std::string> scenes = {"000000", "000001"};
  const std::filesystem::path path = fuzz::write_input("velocities.csv", data, size);
  fuzz::is_taken([&] { experiments::read_velocity_file(path, scenes, scenes); });
  return 0;
}
