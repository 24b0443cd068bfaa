// MCAP files, with the messages in them.
#include "framework/io/recording_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("input.mcap", data, size);
  std::vector<std::string> notices;
  std::vector<CloudTopic> topics;
  fuzz::is_taken([&] { topics = read_recording(path, &notices); });
  for (const CloudTopic& topic : topics) {
    fuzz::require(!topic.clouds.empty(), "a topic without clouds");
    for (const RecordedCloud& cloud : topic.clouds) fuzz::is_taken([&] { cloud.load(); });
  }
  return 0;
}
