#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"

namespace croon {

/// Whether `bytes` begin like a Zstandard frame.
bool is_zstd(std::string_view bytes);

/// Decompresses a Zstandard frame. Throws InputError at `place` if it is damaged, or exceeds
/// `max_bytes` or the memory of this process.
std::string decompress_zstd(std::string_view bytes, std::uint64_t max_bytes, const Fault& place);

/// The same for an LZ4 frame.
std::string decompress_lz4(std::string_view bytes, std::uint64_t max_bytes, const Fault& place);

}  // namespace croon
