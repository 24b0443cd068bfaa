#include "framework/io/decompress.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "framework/base/memory.hpp"

namespace croon {
namespace {

constexpr std::size_t kMinBlockBytes = 1 << 20;

[[noreturn]] void fail(const Fault& place, const std::string& reason) {
  throw InputError(place.file, place.where, "the compressed bytes are damaged: " + reason);
}

/// Collects blocks of bytes until `expand` returns false. `expand(block, size)` writes up to `size`
/// bytes to the block and sets `size` to their number.
template <class Expand>
std::string expanded(std::uint64_t max_bytes, const Fault& place, const Expand& expand) {
  // Memory grows with the actual bytes: a damaged file may declare any size.
  std::string bytes;
  for (bool has_more = true; has_more;) {
    const std::size_t begin = bytes.size();
    require_memory(2.0 * static_cast<double>(begin), "to expand the compressed bytes",
                   "use a recording with smaller chunks", place);
    std::size_t size = std::max(begin, kMinBlockBytes);
    bytes.resize(begin + size);
    has_more = expand(bytes.data() + begin, size);
    bytes.resize(begin + size);
    if (bytes.size() > max_bytes) {
      fail(place, "expected at most " + std::to_string(max_bytes) + " bytes, found more");
    }
  }
  return bytes;
}

}  // namespace

bool is_zstd(std::string_view bytes) { return bytes.substr(0, 4) == "\x28\xb5\x2f\xfd"; }

std::string decompress_zstd(std::string_view bytes, std::uint64_t max_bytes, const Fault& place) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          ZSTD_freeDStream);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  return expanded(max_bytes, place, [&](char* block, std::size_t& size) {
    ZSTD_outBuffer out{block, size, 0};
    const std::size_t code = ZSTD_decompressStream(stream.get(), &out, &in);
    if (ZSTD_isError(code) != 0U) fail(place, ZSTD_getErrorName(code));
    size = out.pos;
    if (code != 0 && in.pos == in.size && out.pos < out.size) fail(place, "they end too early");
    return code != 0;
  });
}

std::string decompress_lz4(std::string_view bytes, std::uint64_t max_bytes, const Fault& place) {
  LZ4F_dctx* created = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0U) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      created, LZ4F_freeDecompressionContext);
  std::size_t next = 0;
  return expanded(max_bytes, place, [&](char* block, std::size_t& size) {
    const std::size_t room = size;
    std::size_t used = bytes.size() - next;
    const std::size_t code =
        LZ4F_decompress(context.get(), block, &size, bytes.data() + next, &used, nullptr);
    if (LZ4F_isError(code) != 0U) fail(place, LZ4F_getErrorName(code));
    next += used;
    const bool is_stuck = used == 0 && size == 0;
    if (code != 0 && (is_stuck || (next == bytes.size() && size < room))) {
      fail(place, "they end too early");
    }
    return code != 0;
  });
}

}  // namespace croon
