#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"

namespace croon {

/// Whether `bytes` begin like a frame of Zstandard.
bool is_zstd(std::string_view bytes);

/// What a frame of Zstandard expands to. Throws InputError at `place` if it is damaged, or expands
/// to more than `max_bytes` or the memory of this process.
std::string decompress_zstd(std::string_view bytes, std::uint64_t max_bytes, const Fault& place);

/// The same for a frame of LZ4.
std::string decompress_lz4(std::string_view bytes, std::uint64_t max_bytes, const Fault& place);

}  // namespace croon
