#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "framework/geometry/point_cloud.hpp"

/// libFuzzer's entry point; each target of this folder defines it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace croon::fuzz {

/// Writes the bytes of an input to the file `name` in a folder of this process, and returns its
/// path. The next input of the same name replaces it.
std::filesystem::path write_input(const std::string& name, const std::uint8_t* data,
                                  std::size_t size);

/// Calls `read`, which reads a file that may hold anything. Returns whether it was taken: an
/// InputError is the right answer to a damaged file. Ends the process if that error does not have
/// at least one fault, each a file and one line; any other exception ends the process too.
bool is_taken(const std::function<void()>& read);

/// The cloud in an input that is written to the file `name`, whose suffix says the format;
/// std::nullopt if it is damaged. Ends the process if the check of the header refuses a cloud that
/// the reader takes.
std::optional<LoadedCloud> read_cloud_input(const std::string& name, const std::uint8_t* data,
                                            std::size_t size);

/// Whether two clouds have the same points and channels, bit for bit; a NaN equals any other.
bool is_equal(const PointCloud& a, const PointCloud& b);

/// Ends the process with `message` unless `condition` holds.
void require(bool condition, const char* message);

}  // namespace croon::fuzz
