// Messages sensor_msgs/msg/PointCloud2 in CDR. Each channel is as long as the points.
#include "framework/io/point_cloud2.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::string message(reinterpret_cast<const char*>(data), size);
  LoadedCloud cloud;
  const bool is_taken = fuzz::is_taken([&] {
    cloud = read_point_cloud2(message, 1.7e9, {"input", "message 1", "", {}});
  });
  if (!is_taken) return 0;
  fuzz::require(read_message_header(message).has_value(), "a cloud without a header");
  for (const Channel& channel : cloud.channels) {
    fuzz::require(channel.bytes.size() == cloud.size() * channel.bytes_per_point(),
                  "a channel is not as long as the points");
  }
  return 0;
}
